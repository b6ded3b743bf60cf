// What a hub does for the service whose hub it is.

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "server/hub/hub.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "tests/server/hub/raw_client.hpp"

namespace genio {
namespace {

using test::eventually;
using test::milliseconds;
using test::RawClient;

/// A client that the hub knows to be the service, and that reads little at a time.
RawClient service_of(Hub& hub) {
  RawClient service = RawClient::greeted(hub.port(), 4096);
  hub.favour(service.port());
  service.subscribe("SERVICE.*");
  EXPECT_TRUE(eventually([&] { return hub.counts().subscriptions == 1; }));
  return service;
}

TEST(FavouredConnection, IsNotDisplacedByManyWhoAreMoreActive) {
  HubLimits limits;
  limits.connections = 10;
  Hub hub(0, limits);
  RawClient service = service_of(hub);
  std::vector<RawClient> others;
  for (int k = 0; k < 30; ++k) {
    others.push_back(RawClient::greeted(hub.port()));
    others.back().publish("A", "x");
    ASSERT_TRUE(eventually([&] { return hub.counts().messages_in >= uint64_t(k + 1); }));
  }
  EXPECT_GE(hub.counts().dropped(HubDrop::displaced), 20u);
  others.back().publish("SERVICE", "still there");
  const auto message = service.receive();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->payload, "still there");
}

TEST(FavouredConnection, FloodsWaitWhileItHasMuchToRead) {
  HubLimits limits;
  limits.backlog_messages = 4000;
  Hub hub(0, limits);
  RawClient service = service_of(hub), reader = RawClient::greeted(hub.port());
  reader.subscribe("OTHER");
  std::vector<char> many;
  for (int k = 0; k < 1000; ++k) {
    const auto one = tcpq::publication("SERVICE", std::string(100, 'x'));
    many.insert(many.end(), one.begin(), one.end());
  }
  RawClient flooder = RawClient::greeted(hub.port()), honest = RawClient::greeted(hub.port());
  std::atomic<bool> stop{false};
  std::thread flooding([&] {
    size_t sent = 0;
    while (!stop) {
      const ssize_t n = flooder.send_some({many.data() + sent, many.size() - sent});
      if (n < 0) break;
      sent = (sent + size_t(n)) % many.size();
      if (n == 0) std::this_thread::sleep_for(milliseconds(1));
    }
  });
  std::this_thread::sleep_for(milliseconds(1000));  // in which the service computes
  EXPECT_EQ(hub.counts().dropped(HubDrop::slow_reader), 0u);
  const uint64_t before = hub.counts().messages_in;
  honest.publish("OTHER", "x");
  EXPECT_TRUE(reader.receive());
  stop = true;
  flooding.join();
  EXPECT_TRUE(service.receive());
  // What waited in the system's buffers is taken once the service reads.
  ASSERT_TRUE(eventually(
      [&] {
        service.receive(milliseconds(1));
        return hub.counts().messages_in > before + 1;
      },
      milliseconds(20000)));
  EXPECT_EQ(hub.counts().dropped(HubDrop::slow_reader), 0u);
}

}  // namespace
}  // namespace genio
