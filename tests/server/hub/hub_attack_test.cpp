// What an honest client notices while others misbehave: nothing.

#include <gtest/gtest.h>

#include "server/hub/hub.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "tests/server/hub/honest_client.hpp"
#include "tests/server/hub/meanwhile.hpp"
#include "tests/server/hub/raw_client.hpp"

namespace genio {
namespace {

using test::eventually;
using test::HonestClient;
using test::Meanwhile;
using test::milliseconds;
using test::RawClient;
using test::worst_of;

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr double soon_ms = 5000;
#else
constexpr double soon_ms = 500;  // on a machine that others use too
#endif
constexpr milliseconds patience{30000};
constexpr double while_ms = 600;             // how long the honest client is watched
constexpr size_t largest_payload = 4 << 20;  // payload

/// The first bytes of a publication that claims `payload` bytes.
std::vector<char> beginning(size_t payload, size_t sent) {
  std::vector<char> bytes = tcpq::publication("A", std::string(payload, 'x'));
  bytes.resize(bytes.size() - (payload - sent));
  return bytes;
}

class HubUnderAttack : public testing::Test {
 protected:
  void expect_service() { EXPECT_LT(worst_of(honest.times_for(while_ms)), soon_ms); }
  std::vector<RawClient> clients(size_t count, int receive_buffer = 0) const {
    std::vector<RawClient> all;
    for (size_t k = 0; k < count; ++k)
      all.push_back(RawClient::greeted(hub.port(), receive_buffer));
    return all;
  }
  uint64_t dropped(HubDrop why) const { return hub.counts().dropped(why); }
  const Hub hub{0};
  HonestClient honest{hub.port()};
};

TEST_F(HubUnderAttack, APatternThatBacktracksForEverCostsNothing) {
  RawClient attacker = RawClient::greeted(hub.port());
  for (const char* pattern : {"(a*)*b", "(a|aa)+b", "((a+)+)+b", "(.*)*(.*)*b"})
    attacker.subscribe(pattern);
  const std::string channel(200, 'a');
  const Meanwhile publishing([&] { attacker.publish(channel, "x"); });
  expect_service();
}

TEST_F(HubUnderAttack, PatternsWithoutEndCostTheConnection) {
  const Meanwhile subscribing([&] {
    RawClient attacker = RawClient::greeted(hub.port());
    for (int k = 0; k < 1000; ++k)
      if (!attacker.subscribe("(" + std::to_string(k) + std::string(240, 'a') + ")*")) break;
  });
  expect_service();
  EXPECT_GT(dropped(HubDrop::refused_pattern), 0u);
}

TEST_F(HubUnderAttack, CostlyPatternsAndChannelsOfAllDelayNobody) {
  auto attackers = clients(60);
  for (RawClient& c : attackers)
    for (int k = 0; k < 8; ++k) c.subscribe(".*a.{1" + std::to_string(k) + "}b");
  const std::vector<char> bytes = tcpq::publication(std::string(255, 'a'), "");
  std::vector<char> many;
  for (int k = 0; k < 200; ++k) many.insert(many.end(), bytes.begin(), bytes.end());
  const Meanwhile publishing([&] {
    for (RawClient& c : attackers) c.send_some({many.data(), many.size()});
  });
  expect_service();
}

TEST_F(HubUnderAttack, SlowReadersOfLargeMessagesAreHeldOnceAndLoseTheirConnections) {
  auto readers = clients(20, 4096);
  for (RawClient& c : readers) c.subscribe("A");
  RawClient publisher = RawClient::greeted(hub.port());
  const std::string payload(largest_payload, 'x');
  size_t most = 0;
  {
    const Meanwhile publishing([&] { publisher.publish("A", payload); });
    const Meanwhile watching([&] { most = std::max(most, hub.counts().queued_bytes); });
    expect_service();
  }
  EXPECT_LE(most, 20u << 20);
  EXPECT_TRUE(eventually([&] { return dropped(HubDrop::slow_reader) == 20; }));
  EXPECT_EQ(hub.counts().connections, 3u);  // the honest ones and the publisher
}

TEST_F(HubUnderAttack, SlowReadersOfDifferentMessagesFillTheQueueToItsLimitAtMost) {
  constexpr size_t count = 24;
  auto readers = clients(count, 4096);
  for (size_t k = 0; k < count; ++k) readers[k].subscribe("A" + std::to_string(k));
  RawClient publisher = RawClient::greeted(hub.port());
  const std::string payload(largest_payload - 100, 'x');
  size_t most = 0, next = 0;
  {
    const Meanwhile publishing(
        [&] { publisher.publish("A" + std::to_string(next++ % count), payload); });
    const Meanwhile watching([&] { most = std::max(most, hub.counts().queued_bytes); });
    expect_service();
    EXPECT_TRUE(eventually([&] { return dropped(HubDrop::slow_reader) >= 8; }, patience));
  }
  EXPECT_LE(most, HubLimits{}.queued_bytes);
}

TEST_F(HubUnderAttack, TinyMessagesThatNobodyReadsCountForWhatTheyTake) {
  auto readers = clients(100, 4096);
  for (RawClient& c : readers) c.subscribe("A");
  RawClient publisher = RawClient::greeted(hub.port());
  std::vector<char> many;
  for (int k = 0; k < 2000; ++k) {
    const auto one = tcpq::publication("A", "");
    many.insert(many.end(), one.begin(), one.end());
  }
  size_t most = 0;
  {
    const Meanwhile publishing([&] { publisher.send(many); });
    const Meanwhile watching([&] { most = std::max(most, hub.counts().queued_bytes); });
    expect_service();
  }
  EXPECT_LE(most, HubLimits{}.queued_bytes);
}

TEST_F(HubUnderAttack, UnfinishedMessagesTakeTheirRoomAtMostAndTheOldestGo) {
  constexpr size_t count = 40;
  auto attackers = clients(count);
  const std::vector<char> bytes = beginning(largest_payload, largest_payload - 1);
  for (RawClient& c : attackers) c.send(bytes);
  expect_service();
  EXPECT_LE(hub.counts().partial_bytes, HubLimits{}.partial_bytes);
  EXPECT_TRUE(eventually([&] {
    return dropped(HubDrop::stalled) >= count - HubLimits{}.partial_bytes / largest_payload;
  }));
  // A large message of somebody else passes.
  RawClient publisher = RawClient::greeted(hub.port());
  publisher.subscribe("LARGE");
  publisher.publish("LARGE", std::string(largest_payload, 'y'));
  EXPECT_TRUE(publisher.receive());
}

TEST_F(HubUnderAttack, ClaimsOfLargeMessagesTakeNoMemory) {
  auto attackers = clients(200);
  const std::vector<char> bytes = beginning(largest_payload, 100);
  for (RawClient& c : attackers) c.send(bytes);
  ASSERT_TRUE(eventually([&] { return hub.counts().partial_bytes > 200u * 100; }));
  EXPECT_LT(hub.counts().partial_bytes, 1u << 20);
  expect_service();
}

TEST_F(HubUnderAttack, IdleConnectionsMakePlaceForHonestOnes) {
  std::vector<RawClient> silent(300), greeted = clients(300);
  for (RawClient& c : silent) c.connect(hub.port());
  HonestClient newcomer(hub.port(), "NEWCOMER");
  EXPECT_LT(newcomer.one_way_ms(), soon_ms);
  expect_service();
  EXPECT_GT(dropped(HubDrop::displaced), 0u);
  EXPECT_LE(hub.counts().connections, HubLimits{}.connections);
}

TEST_F(HubUnderAttack, ConnectionsWithoutEndLetHonestOnesIn) {
  std::vector<RawClient> ring(300);
  size_t next = 0;
  const Meanwhile connecting([&] {
    RawClient& c = ring[next++ % ring.size()] = RawClient();
    c.connect(hub.port());
    if (next % 2) c.greet();
  });
  ASSERT_TRUE(eventually([&] { return hub.counts().accepted > 400; }));
  for (int k = 0; k < 3; ++k) {
    HonestClient newcomer(hub.port(), "NEWCOMER");
    EXPECT_LT(newcomer.one_way_ms(), soon_ms);
  }
  expect_service();
}

TEST_F(HubUnderAttack, FloodsOfLargeMessagesDelayNobody) {
  auto attackers = clients(8);
  const std::vector<char> bytes = tcpq::publication("HONEST_NOT", std::string(65536, 'x'));
  const Meanwhile flooding([&] {
    for (RawClient& c : attackers) c.send_some({bytes.data(), bytes.size()});
  });
  expect_service();
}

TEST_F(HubUnderAttack, FloodsOfTinyMessagesToManyDelayNobody) {
  auto attackers = clients(60);
  std::vector<char> many;
  for (int k = 0; k < 2000; ++k) {
    const auto one = tcpq::publication("A", "");
    many.insert(many.end(), one.begin(), one.end());
  }
  for (RawClient& c : attackers) c.subscribe(".*");
  const Meanwhile flooding([&] {
    for (RawClient& c : attackers) c.send(many);
  });
  const Meanwhile reading([&] {
    for (RawClient& c : attackers) c.sip(1 << 16);
  });
  expect_service();
}

TEST_F(HubUnderAttack, FloodsOfTwoHundredDelayNobodyAndLeaveTheProcessorToOthers) {
  auto attackers = clients(200);
  const std::vector<char> large = tcpq::publication("HONEST_NOT", std::string(65536, 'x'));
  std::vector<size_t> sent(attackers.size());
  const Meanwhile flooding([&] {
    for (size_t k = 0; k < attackers.size(); ++k) {
      const ssize_t n = attackers[k].send_some({large.data() + sent[k], large.size() - sent[k]});
      sent[k] = (sent[k] + size_t(std::max<ssize_t>(n, 0))) % large.size();
    }
  });
  expect_service();
  EXPECT_EQ(hub.counts().connections, 202u);
}

TEST_F(HubUnderAttack, WhoSendsAndLeavesAgainAndAgainDisplacesNobodyWhoStays) {
  std::vector<RawClient> ring(200);
  std::vector<char> many;
  for (int k = 0; k < 200; ++k) {
    const auto one = tcpq::publication("A", "");
    many.insert(many.end(), one.begin(), one.end());
  }
  size_t next = 0;
  const Meanwhile connecting([&] {
    RawClient& c = ring[next++ % ring.size()] = RawClient();
    c.connect(hub.port());
    c.greet();
    c.send_some({many.data(), many.size()});
  });
  ASSERT_TRUE(eventually([&] { return hub.counts().accepted > 400; }));
  expect_service();
}

}  // namespace
}  // namespace genio
