// Debian's programs for LCM, beside the hub.

#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "server/hub/hub.hpp"
#include "server/link/link.hpp"
#include "tests/server/hub/raw_client.hpp"

extern char** environ;

namespace genio {
namespace {

using test::eventually;
using test::milliseconds;
namespace fs = std::filesystem;

/// A program that runs beside the test, and ends with this object at the latest.
class Program {
 public:
  explicit Program(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (posix_spawnp(&pid_, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
      pid_ = 0;
  }
  ~Program() {
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  bool runs() const { return pid_ > 0; }
  void ask_to_end() const { kill(pid_, SIGTERM); }
  /// True once it has ended by itself.
  bool ends(milliseconds longest = milliseconds(20000)) {
    return eventually(
        [&] {
          if (pid_ > 0 && waitpid(pid_, nullptr, WNOHANG) == pid_) pid_ = 0;
          return pid_ == 0;
        },
        longest);
  }

 private:
  pid_t pid_ = 0;
};

class LcmPrograms : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "genio-hub-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }
  const Hub hub{0};
  const std::string url = "tcpq://127.0.0.1:" + std::to_string(hub.port());
  fs::path folder;
};

TEST_F(LcmPrograms, WhatTheLoggerRecordsThePlayerPlays) {
  std::multimap<std::string, std::string> sent, played;
  const std::string log = (folder / "log").string();
  size_t log_bytes = 0;
  constexpr size_t event_header = 28;  // of LCM's log files
  constexpr const char* end = "END";
  {
    Program logger({"lcm-logger", "--lcm-url=" + url, "--quiet", "--flush-interval=10", log});
    ASSERT_TRUE(logger.runs());
    ASSERT_TRUE(eventually([&] { return hub.counts().subscriptions == 1; }));
    lcm_t* const publisher = lcm_create(url.c_str());
    ASSERT_TRUE(publisher);
    for (int k = 0; k < 40; ++k) {
      const std::string channel = k % 2 ? "GENIO_REQUEST" : "OTHER.channel-" + std::to_string(k);
      const std::string payload(k == 7 ? 1 << 20 : size_t(k), char('a' + k % 26));
      ASSERT_EQ(lcm_publish(publisher, channel.c_str(), payload.data(), unsigned(payload.size())),
                0);
      sent.emplace(channel, payload);
      log_bytes += channel.size() + payload.size();
    }
    // The logger writes what it has when something more comes.
    EXPECT_TRUE(eventually([&] {
      lcm_publish(publisher, end, "", 0);
      return fs::exists(log) && fs::file_size(log) > log_bytes + sent.size() * event_header;
    }));
    lcm_destroy(publisher);
    logger.ask_to_end();
    EXPECT_TRUE(logger.ends());
  }
  Link subscriber(url);
  subscriber.subscribe(".*", [&](const std::string& channel, const void* data, size_t size) {
    if (channel != end) played.emplace(channel, std::string(static_cast<const char*>(data), size));
  });
  ASSERT_TRUE(eventually([&] { return hub.counts().subscriptions == 1; }));
  Program player({"lcm-logplayer", "--lcm-url=" + url, "--speed=100", log});
  ASSERT_TRUE(player.runs());
  EXPECT_TRUE(eventually([&] {
    subscriber.wait(10);
    return played.size() >= sent.size();
  }));
  EXPECT_TRUE(player.ends());
  EXPECT_TRUE(played == sent);
}

TEST_F(LcmPrograms, TheLoggerChoosesChannelsByRegularExpression) {
  const std::string log = (folder / "log").string();
  const Program logger(
      {"lcm-logger", "--lcm-url=" + url, "--quiet", "--channel=(GENIO|ARM)_.*$", log});
  ASSERT_TRUE(logger.runs());
  ASSERT_TRUE(eventually([&] { return hub.counts().subscriptions == 1; }));
  Link publisher(url);
  for (const char* channel : {"GENIO_STATUS", "ARM_STATE", "LEG_STATE", "GENIO"})
    EXPECT_TRUE(publisher.publish(channel, {1, 2, 3}));
  EXPECT_TRUE(eventually([&] { return hub.counts().messages_in == 4; }));
  EXPECT_TRUE(eventually([&] { return hub.counts().messages_out == 2; }));
}

}  // namespace
}  // namespace genio
