// What a hub does for the service whose hub it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

#include "forward/base/elapsed.hpp"
#include "server/hub/hub.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "tests/server/hub/meanwhile.hpp"
#include "tests/server/hub/raw_client.hpp"

namespace genio {
namespace {

using test::eventually;
using test::Meanwhile;
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
  std::optional<Meanwhile> flooding(std::in_place, [&, sent = size_t(0)]() mutable {
    const ssize_t n = flooder.send_some({many.data() + sent, many.size() - sent});
    if (n > 0) sent = (sent + size_t(n)) % many.size();
    else std::this_thread::sleep_for(milliseconds(1));
  });
  std::this_thread::sleep_for(milliseconds(1000));  // in which the service computes
  EXPECT_EQ(hub.counts().dropped(HubDrop::slow_reader), 0u);
  const uint64_t before = hub.counts().messages_in;
  honest.publish("OTHER", "x");
  EXPECT_TRUE(reader.receive());
  flooding.reset();
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

/// A turn of many who send little each: none of them has more ready than a turn of the hub takes.
auto light_flood(uint16_t port, size_t connections) {
  std::vector<RawClient> all;
  for (size_t k = 0; k < connections; ++k) all.push_back(RawClient::greeted(port));
  return [clients = std::make_shared<std::vector<RawClient>>(std::move(all)),
          bytes = tcpq::publication("SERVICE", std::string(200, 'x'))] {
    for (RawClient& c : *clients) c.send_some({bytes.data(), bytes.size()});
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  };
}

TEST(FavouredConnection, ManyWhoSendALittleEachDoNotCostItItsPlace) {
  HubLimits limits;
  limits.backlog_bytes = 64 << 10;
  Hub hub(0, limits);
  RawClient service = service_of(hub);
  {
    const Meanwhile flood(light_flood(hub.port(), 20));
    std::this_thread::sleep_for(milliseconds(1000));  // in which the service computes
  }
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(service.receive());
  EXPECT_EQ(hub.counts().dropped(HubDrop::slow_reader), 0u);
}

TEST(FavouredConnection, WhoSendsOneMessageGoesBeforeThoseOfWhomMuchWaits) {
  Hub hub(0);
  RawClient service = service_of(hub), honest = RawClient::greeted(hub.port());
  const Meanwhile flood(light_flood(hub.port(), 20));
  ASSERT_TRUE(eventually([&] { return hub.counts().messages_in > 1000; }));
  honest.publish("SERVICE", "honest");
  ASSERT_TRUE(eventually([&] { return hub.counts().connections == 22; }));
  std::this_thread::sleep_for(milliseconds(200));
  int before = 0;
  while (service.receive().value().payload != "honest") ++before;
  // What is in the buffers of the system, and one of each who floods; of 20 some 64 each wait.
  EXPECT_LT(before, 800);
}

TEST(FavouredConnection, WhoLeavesWhileHeldBackKeepsNobodyBusy) {
  Hub hub(0);
  const RawClient service = service_of(hub);
  {
    RawClient flooder = RawClient::greeted(hub.port());
    const auto one = tcpq::publication("SERVICE", std::string(1000, 'x'));
    for (int k = 0; k < 20000; ++k)
      if (flooder.send_some({one.data(), one.size()}) < ssize_t(one.size())) break;
    std::this_thread::sleep_for(milliseconds(100));
  }  // leaves with unread bytes of the hub, which resets the connection
  std::this_thread::sleep_for(milliseconds(500));
  const double before = processor_seconds();
  std::this_thread::sleep_for(milliseconds(300));
  EXPECT_LT(processor_seconds() - before, 0.15);
}

TEST(FavouredConnection, WhoComesAnewForEachMessageGainsNothing) {
  HubLimits limits;
  limits.connections = 40;
  Hub hub(0, limits);
  RawClient service = service_of(hub), honest = RawClient::greeted(hub.port());
  honest.subscribe("HONEST");
  std::this_thread::sleep_for(milliseconds(1100));  // no newcomer any more
  const auto one = tcpq::publication("SERVICE", std::string(40000, 'x'));
  std::optional<Meanwhile> coming(std::in_place, [&] {
    RawClient newcomer = RawClient::greeted(hub.port());
    newcomer.send_some({one.data(), one.size()});
  });
  std::this_thread::sleep_for(milliseconds(1000));
  honest.publish("SERVICE", "honest");
  std::this_thread::sleep_for(milliseconds(200));
  int before = 0;
  while (before < 1000 && service.receive().value().payload != "honest") ++before;
  EXPECT_LT(before, 20);
  coming.reset();
  EXPECT_LT(hub.counts().queued_bytes, 4u << 20);
  EXPECT_TRUE(honest.publish("SERVICE", "still there"));
}

TEST(FavouredConnection, LargeMessagesOfManyWaitForItWithinTheirRoom) {
  Hub hub(0);
  RawClient service = service_of(hub);
  std::vector<RawClient> senders;
  for (int k = 0; k < 30; ++k) senders.push_back(RawClient::greeted(hub.port()));
  const auto large = tcpq::publication("SERVICE", std::string(4 << 20, 'x'));
  std::vector<size_t> sent(senders.size());
  for (int round = 0; round < 400; ++round)
    for (size_t k = 0; k < senders.size(); ++k) {
      const size_t at = sent[k] % large.size();
      sent[k] += size_t(
          std::max<ssize_t>(0, senders[k].send_some({large.data() + at, large.size() - at})));
    }
  EXPECT_LT(hub.counts().queued_bytes, HubLimits{}.queued_bytes);
  for (int k = 0; k < 4; ++k) EXPECT_TRUE(service.receive());
}

}  // namespace
}  // namespace genio
