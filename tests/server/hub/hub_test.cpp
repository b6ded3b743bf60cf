// What a hub does for clients that keep to the protocol, and when it parts with others.

#include "server/hub/hub.hpp"

#include <gtest/gtest.h>

#include "forward/base/types.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "tests/server/hub/raw_client.hpp"

namespace genio {
namespace {

using test::eventually;
using test::milliseconds;
using test::RawClient;

/// Limits that are reached soon.
HubLimits small_limits() {
  HubLimits limits;
  limits.greeting = milliseconds(100);
  limits.partial = milliseconds(100);
  limits.draining = milliseconds(200);
  return limits;
}

/// A client that has subscribed, once the hub knows.
RawClient subscriber(const Hub& hub, const std::string& pattern, int receive_buffer = 0) {
  const size_t before = hub.counts().subscriptions;
  RawClient client = RawClient::greeted(hub.port(), receive_buffer);
  client.subscribe(pattern);
  EXPECT_TRUE(eventually([&] { return hub.counts().subscriptions > before; }));
  return client;
}

bool has_dropped(const Hub& hub, HubDrop why, uint64_t count = 1) {
  return eventually([&] { return hub.counts().dropped(why) == count; });
}

TEST(Hub, MessagesReachWhoSubscribedInTheirOrder) {
  const Hub hub(0);
  RawClient all = subscriber(hub, ".*"), some = subscriber(hub, "B.*");
  RawClient publisher = RawClient::greeted(hub.port());
  for (int k = 0; k < 300; ++k) publisher.publish(k % 3 ? "A" : "BC", std::to_string(k));
  for (int k = 0; k < 300; ++k) {
    const auto message = all.receive();
    ASSERT_TRUE(message);
    EXPECT_EQ(message->payload, std::to_string(k));
    EXPECT_EQ(message->channel, k % 3 ? "A" : "BC");
  }
  for (int k = 0; k < 300; k += 3) {
    const auto message = some.receive();
    ASSERT_TRUE(message);
    EXPECT_EQ(message->payload, std::to_string(k));
  }
  EXPECT_FALSE(some.receive(milliseconds(50)));
}

TEST(Hub, WhoPublishesGetsItToo) {
  const Hub hub(0);
  RawClient client = RawClient::greeted(hub.port());
  client.subscribe("A");
  client.publish("A", "own");
  const auto message = client.receive();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->payload, "own");
}

TEST(Hub, AMessageComesOncePerClientHoweverManyPatternsMatch) {
  const Hub hub(0);
  RawClient client = RawClient::greeted(hub.port());
  for (const char* pattern : {"A", ".*", "(A|B)", "A"}) client.subscribe(pattern);
  client.publish("A", "x");
  EXPECT_TRUE(client.receive());
  EXPECT_FALSE(client.receive(milliseconds(50)));
}

TEST(Hub, UnsubscribingEndsIt) {
  const Hub hub(0);
  RawClient client = RawClient::greeted(hub.port());
  client.subscribe("A");
  client.subscribe("B");
  client.send(tcpq::subscription("A", tcpq::unsubscribe));
  client.publish("A", "x");
  client.publish("B", "y");
  const auto message = client.receive();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->channel, "B");
}

TEST(Hub, TheLargestMessageOfGenioPassesAndALargerOneIsRefused) {
  const Hub hub(0);
  const HubLimits limits;
  RawClient reader = subscriber(hub, "A");
  RawClient publisher = RawClient::greeted(hub.port());
  const std::string largest(limits.payload_bytes, 'x');
  EXPECT_TRUE(publisher.publish("A", largest));
  const auto message = reader.receive();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->payload, largest);
  publisher.publish("A", largest + "x");
  EXPECT_TRUE(publisher.sees_the_end());
  EXPECT_TRUE(has_dropped(hub, HubDrop::too_large));
  EXPECT_FALSE(reader.receive(milliseconds(50)));
}

TEST(Hub, CountsWhatItDid) {
  const Hub hub(0);
  RawClient one = subscriber(hub, "A"), two = subscriber(hub, "A");
  one.publish("A", "123");
  one.publish("B", "nobody");
  ASSERT_TRUE(one.receive() && two.receive());
  ASSERT_TRUE(eventually([&] { return hub.counts().messages_in == 2; }));
  HubCounts counts = hub.counts();
  EXPECT_EQ(counts.connections, 2u);
  EXPECT_EQ(counts.subscriptions, 2u);
  EXPECT_EQ(counts.accepted, 2u);
  EXPECT_EQ(counts.messages_out, 2u);
  const size_t greeting = 8, subscription = 9, published = 16 + 19;
  EXPECT_EQ(counts.bytes_in, 2 * greeting + 2 * subscription + published);
  EXPECT_EQ(counts.bytes_out, 2 * greeting + 2 * 16);
  EXPECT_EQ(counts.queued_bytes, 0u);
  EXPECT_EQ(counts.partial_bytes, 0u);
  two.close();
  EXPECT_TRUE(eventually([&] { return hub.counts().connections == 1; }));
  counts = hub.counts();
  EXPECT_EQ(counts.subscriptions, 1u);
  for (const uint64_t dropped : counts.drops) EXPECT_EQ(dropped, 0u);  // leaving is no fault
}

TEST(Hub, PortInUseIsAnError) {
  const Hub first(0);
  EXPECT_THROW(Hub second(first.port()), InputError);
}

TEST(Hub, ItsPortIsFreeAfterwardsAlsoWithClientsLeft) {
  auto first = std::make_unique<Hub>(0);
  const uint16_t port = first->port();
  RawClient client = RawClient::greeted(port);
  ASSERT_TRUE(eventually([&] { return first->counts().connections == 1; }));
  first.reset();
  EXPECT_TRUE(client.sees_the_end());
  const Hub second(port);
  EXPECT_EQ(second.port(), port);
}

TEST(Hub, WhoSpeaksOtherwiseLosesTheConnection) {
  const Hub hub(0);
  RawClient browser;
  browser.connect(hub.port());
  browser.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_TRUE(browser.sees_the_end());
  RawClient other = RawClient::greeted(hub.port());
  other.send(tcpq::subscription("A", 7));
  EXPECT_TRUE(other.sees_the_end());
  EXPECT_TRUE(has_dropped(hub, HubDrop::malformed, 2));
}

TEST(Hub, WhoDoesNotGreetIsSentAwayAndWhoGreetedMayBeSilent) {
  const Hub hub(0, small_limits());
  RawClient greeted = subscriber(hub, "A");
  RawClient silent, half;
  silent.connect(hub.port());
  half.connect(hub.port());
  half.send(std::string_view("\x28\x76\x17\xfb", 4));
  EXPECT_TRUE(silent.sees_the_end());
  EXPECT_TRUE(half.sees_the_end());
  EXPECT_TRUE(has_dropped(hub, HubDrop::not_greeted, 2));
  EXPECT_FALSE(greeted.sees_the_end(milliseconds(150)));
  greeted.publish("A", "x");
}

TEST(Hub, AMessageThatDoesNotGoOnEndsTheConnectionAndOneThatDoesIsTaken) {
  const Hub hub(0, small_limits());
  RawClient stuck = RawClient::greeted(hub.port()), slow = subscriber(hub, "A");
  const std::vector<char> whole = tcpq::publication("A", "slowly");
  const std::string_view bytes(whole.data(), whole.size());
  stuck.send(bytes.substr(0, 10));
  for (size_t k = 0; k < bytes.size(); k += 4) {  // longer in all than the hub waits for one piece
    slow.send(bytes.substr(k, 4));
    EXPECT_FALSE(slow.sees_the_end(milliseconds(40)));
  }
  EXPECT_TRUE(stuck.sees_the_end());
  EXPECT_TRUE(has_dropped(hub, HubDrop::stalled));
  EXPECT_TRUE(eventually([&] { return hub.counts().messages_out == 1; }));
}

TEST(Hub, WhoTakesNothingForTooLongLosesTheConnection) {
  const Hub hub(0, small_limits());
  RawClient slow = subscriber(hub, "A", 4096);
  RawClient publisher = RawClient::greeted(hub.port());
  publisher.publish("A", std::string(4 << 20, 'x'));
  EXPECT_TRUE(has_dropped(hub, HubDrop::slow_reader));
  EXPECT_TRUE(eventually([&] { return hub.counts().queued_bytes == 0; }));
  EXPECT_FALSE(publisher.sees_the_end(milliseconds(50)));
}

TEST(Hub, WhoReadsSlowlyButReadsKeepsTheConnection) {
  HubLimits limits = small_limits();
  const Hub hub(0, limits);
  RawClient slow = subscriber(hub, "A", 65536);
  RawClient publisher = RawClient::greeted(hub.port());
  const std::string payload(4 << 20, 'x');
  publisher.publish("A", payload);
  std::optional<RawClient::Message> message;
  for (int k = 0; k < 200 && !message; ++k) message = slow.receive(milliseconds(5));
  ASSERT_TRUE(message);
  EXPECT_EQ(message->payload, payload);
  EXPECT_EQ(hub.counts().dropped(HubDrop::slow_reader), 0u);
}

TEST(Hub, PatternsThatAreNoneOrTooManyEndTheConnection) {
  const Hub hub(0);
  const HubLimits limits;
  std::vector<RawClient> clients;
  for (int k = 0; k < 4; ++k) clients.push_back(RawClient::greeted(hub.port()));
  clients[0].subscribe("(");
  clients[1].subscribe(std::string(limits.name_bytes + 1, 'a'));
  for (size_t k = 0; k <= limits.subscriptions; ++k) clients[2].subscribe("A" + std::to_string(k));
  for (size_t k = 0; k <= limits.programs; ++k)
    clients[3].subscribe("(A|" + std::to_string(k) + ")");
  for (RawClient& client : clients) EXPECT_TRUE(client.sees_the_end());
  EXPECT_TRUE(has_dropped(hub, HubDrop::refused_pattern, 4));
  RawClient honest = RawClient::greeted(hub.port());
  for (size_t k = 0; k < limits.subscriptions; ++k) honest.subscribe(std::to_string(k));
  EXPECT_TRUE(eventually([&] { return hub.counts().subscriptions == limits.subscriptions; }));
}

TEST(Hub, CostlyPatternsOfManyClientsCostTheCostliest) {
  HubLimits limits;
  limits.program_cost = 1000;
  const Hub hub(0, limits);
  RawClient modest = subscriber(hub, "(A|B)");
  std::vector<RawClient> greedy;
  for (int k = 0; k < 5; ++k) {
    greedy.push_back(RawClient::greeted(hub.port()));
    greedy.back().subscribe(".*a.{250}");
  }
  EXPECT_TRUE(eventually([&] { return hub.counts().dropped(HubDrop::refused_pattern) >= 2; }));
  EXPECT_FALSE(modest.sees_the_end(milliseconds(50)));
  modest.publish("A", "still here");
  EXPECT_TRUE(modest.receive());
}

}  // namespace
}  // namespace genio
