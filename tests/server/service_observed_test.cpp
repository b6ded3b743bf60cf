// What a running service tells of itself.

#include <fcntl.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <thread>

#include "server/client.hpp"
#include "server/hub/hub.hpp"
#include "server/served_model.hpp"
#include "server/service.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/runs/temporary_folder.hpp"
#include "tests/server/hub/raw_client.hpp"
#include "tests/server/observe/manager_socket.hpp"

namespace genio {
namespace {

class ObservedService : public testing::Test {
 protected:
  ObservedService() {
    { port = Hub(0).port(); }  // one that was just given back
    options.url = "tcpq://127.0.0.1:" + std::to_string(port);
    options.observer = &observer;
  }
  void start() {
    thread = std::thread([this] { serve(nursery, identities(models), options, stop); });
  }
  void end() {
    stop = true;
    if (thread.joinable()) thread.join();
  }
  void TearDown() override { end(); }
  bool heard(const std::string& message) {
    for (std::string next = socket.next(); !next.empty(); next = socket.next())
      if (next == message) return true;
    return false;
  }
  std::string log_text() {
    log.reset();
    return test::content_of(path);
  }

  std::vector<ServedModel> models = read_served_models({test::generic_model()});
  const Model& model = *models.front().model;
  const Nursery nursery{worker_of(models, 2000)};
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/log";
  const Descriptor file{open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600)};
  std::unique_ptr<Log> log = std::make_unique<Log>(LogForm::text, file.get());
  test::ManagerSocket socket;
  ServiceManager manager{socket.address(), 0.2};
  Observer observer{{log.get(), nullptr, &manager, {}, {}}};
  uint16_t port = 0;
  ServiceOptions options;
  std::atomic<bool> stop{false};
  std::thread thread;
};

constexpr std::chrono::milliseconds long_enough{120000};

TEST_F(ObservedService, IsReadyOnlyOnceClientsCanBeHeard) {
  start();
  // Its loop turns, and yet nobody could reach it.
  ASSERT_TRUE(test::eventually([&] { return heard("WATCHDOG=1"); }, long_enough));
  for (int k = 0; k < 15; ++k) {
    EXPECT_FALSE(heard("READY=1"));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  const Hub hub(port);
  ASSERT_TRUE(test::eventually([&] { return heard("READY=1"); }, long_enough));
  EXPECT_TRUE(Client(options.url).status(10));
  end();
  EXPECT_FALSE(heard("READY=1"));  // once is enough
}

TEST_F(ObservedService, NoNameFromOutsideForgesALineOfTheLog) {
  const Hub hub(port);
  start();
  Client client(options.url, "honest");
  shape_request_t r{};
  r.id =
      "x status=converged \xc2\x9b"
      "2J\xff";
  r.point_count = 1;
  r.x_mm = {0}, r.y_mm = {0}, r.z_mm = {std::nan("")}, r.sigma_mm = {1}, r.kind = {"dorsum"};
  ASSERT_TRUE(client.request(r, 120));
  end();
  const std::string text = log_text();
  EXPECT_NE(
      text.find(R"( answered id="x status=converged \xc2\x9b2J\xff" client=honest status=failed)"),
      text.npos)
      << text;
  std::istringstream lines(text);
  std::string line, all;
  while (std::getline(lines, line)) {
    const size_t event = line.find(' ', line.find(' ') + 1) + 1;
    all += line.substr(event, line.find(' ', event) - event) + ' ';
  }
  EXPECT_EQ(all, "serving answered stopped ");
}

TEST_F(ObservedService, ASecondLifeSaysWhatTheFirstLeft) {
  options.journal = folder.path() + "/journal";
  const Hub hub(port);
  start();
  ASSERT_TRUE(Client(options.url).status(120));
  Link link(options.url);
  const Vec3 top = 1e3 * model.mesh.nodes[size_t(model.landmarks.dorsum)];
  shape_request_t r{};
  r.client = "absent", r.bilateral = -1;
  r.starts = 1000;  // the first takes longer than this test
  r.point_count = 1;
  r.x_mm = {top[0]}, r.y_mm = {0}, r.z_mm = {top[2]}, r.sigma_mm = {1}, r.kind = {"dorsum"};
  for (const char* id : {"a", "b", "c"}) {
    r.id = id;
    link.publish("GENIO_REQUEST", encode(r));
  }
  Client client(options.url);
  ASSERT_TRUE(test::eventually([&] { return client.status(10)->received == 3; }, long_enough));
  end();
  stop = false;
  start();
  ASSERT_TRUE(client.status(120));
  end();
  const std::string text = log_text();
  EXPECT_NE(text.find(" stopped finished=0 journalled=3 refused=0 "), text.npos) << text;
  EXPECT_NE(text.find(" resumed requests=3"), text.npos) << text;
}

}  // namespace
}  // namespace genio
