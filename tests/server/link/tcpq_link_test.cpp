// A connection to a hub that does anything but what a hub should.

#include "server/link/tcpq_link.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <thread>

#include "forward/base/elapsed.hpp"
#include "forward/base/types.hpp"
#include "server/client.hpp"
#include "server/hub/hub.hpp"
#include "server/hub/protocol/tcpq.hpp"

namespace genio {
namespace {

constexpr double generous_s = 20;  // LCM's own client waits for ever

/// Takes connections on a free port, and sends each what `say` gives for its number.
class BadHub {
 public:
  using Say = std::function<std::vector<char>(int connection)>;

  explicit BadHub(Say say) : say_(std::move(say)), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET, address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), size), 0);
    listen(listener_.get(), 16);
    getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] {
      for (int k = 0;; ++k) {
        Descriptor taken(accept(listener_.get(), nullptr, nullptr));
        if (!taken) return;
        for (const char byte : say_(k)) send(taken.get(), &byte, 1, MSG_NOSIGNAL);
        taken_.push_back(std::move(taken));
        ++connections;
      }
    });
  }
  ~BadHub() {
    shutdown(listener_.get(), SHUT_RDWR);
    thread_.join();
  }
  std::string url() const { return "tcpq://127.0.0.1:" + std::to_string(port_); }
  std::atomic<int> connections{0};

 private:
  const Say say_;
  Descriptor listener_;
  uint16_t port_ = 0;
  std::vector<Descriptor> taken_;
  std::thread thread_;
};

std::vector<char> whole_greeting() { return tcpq::greeting(tcpq::server_mark); }

TEST(TcpqLink, AHubThatNeverGreetsCostsNobodyMoreThanTheirTime) {
  BadHub hub([](int) { return std::vector<char>{0x28}; });
  const Stopwatch watch;
  TcpqLink link(hub.url());
  EXPECT_FALSE(link.connected());
  EXPECT_FALSE(link.publish("A", {1}));
  EXPECT_FALSE(link.wait(50, {}));
  EXPECT_LT(watch.seconds(), generous_s);
  Client client(hub.url());
  EXPECT_FALSE(client.request({}, 0.3));
  EXPECT_FALSE(client.status(0.3));
  EXPECT_LT(watch.seconds(), generous_s);
}

// LCM connects a second time, and the first greeting says nothing of that.
TEST(TcpqLink, AHubThatGreetsOnceAndNeverAgainIsWaitedForWithinBounds) {
  BadHub hub([](int k) { return k == 0 ? whole_greeting() : std::vector<char>{}; });
  const Stopwatch watch;
  TcpqLink first(hub.url());
  EXPECT_TRUE(first.connected());
  Client second(hub.url());
  EXPECT_FALSE(second.connected());
  EXPECT_FALSE(second.request({}, 0.3));
  EXPECT_LT(watch.seconds(), generous_s);
}

TEST(TcpqLink, AMessageThatStopsInItsMiddleHoldsNobodyUp) {
  BadHub hub([](int) {
    std::vector<char> bytes = whole_greeting();
    const auto message = tcpq::publication("A", std::string(1000, 'x'));
    bytes.insert(bytes.end(), message.begin(), message.end() - 1);
    return bytes;
  });
  TcpqLink link(hub.url());
  ASSERT_TRUE(link.connected());
  int handled = 0;
  link.subscribe("A", [&](const std::string&, const void*, size_t) { ++handled; });
  const Stopwatch watch;
  for (int k = 0; k < 10; ++k) link.wait(20, {});
  EXPECT_LT(watch.seconds(), 4);  // where each once waited for five
  EXPECT_EQ(handled, 0);
  EXPECT_TRUE(link.connected());
}

TEST(TcpqLink, NonsenseAndLengthsThatNoMessageHasEndTheConnectionAndAnotherIsMade) {
  std::vector<char> huge = whole_greeting(), strange = whole_greeting();
  for (const uint32_t word : {tcpq::publish, 1u}) tcpq::append_word(huge, word);
  huge.push_back('A');
  tcpq::append_word(huge, 0xffffffffu);
  for (int k = 0; k < 3; ++k) tcpq::append_word(strange, 77);
  const std::vector<char> another_mark = tcpq::greeting(tcpq::client_mark);
  for (const std::vector<char>& said : {huge, strange, another_mark}) {
    BadHub hub([&](int) { return said; });
    TcpqLink link(hub.url());
    const Stopwatch watch;
    while (hub.connections < 3 && watch.seconds() < generous_s) link.wait(20, {});
    EXPECT_GE(hub.connections, 3);
  }
}

TEST(TcpqLink, WhereNobodyListensItDoesNotTurnWithoutPause) {
  std::string free;  // a port that was just given back
  { free = "tcpq://127.0.0.1:" + std::to_string(Hub(0).port()); }
  TcpqLink link(free);
  const double before = processor_seconds();
  for (int k = 0; k < 10; ++k) EXPECT_FALSE(link.wait(100, {}));
  EXPECT_LT(processor_seconds() - before, 0.5);
}

TEST(TcpqLink, AHandlerThatPublishesWhileItsHubGoesIsCalledNoMore) {
  auto hub = std::make_unique<Hub>(0);
  const std::string url = "tcpq://127.0.0.1:" + std::to_string(hub->port());
  TcpqLink link(url);
  int handled = 0;
  link.subscribe("A", [&](const std::string&, const void*, size_t) {
    ++handled;
    hub.reset();
    for (int k = 0; k < 100; ++k) link.publish("A", {1});
  });
  for (int k = 0; k < 20; ++k) link.publish("A", {1});
  const Stopwatch watch;
  while (hub && watch.seconds() < generous_s) link.wait(20, {});
  EXPECT_GE(handled, 1);
  EXPECT_FALSE(link.wait(20, {}));
}

TEST(TcpqLink, WhatIsNoPatternIsRefused) {
  const Hub hub(0);
  TcpqLink link("tcpq://127.0.0.1:" + std::to_string(hub.port()));
  EXPECT_THROW(link.subscribe("(", [](const std::string&, const void*, size_t) {}), InputError);
}

}  // namespace
}  // namespace genio
