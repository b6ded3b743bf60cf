#include "server/hub/protocol/parser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "server/hub/protocol/tcpq.hpp"

namespace genio {
namespace {

constexpr size_t max_name = 256, max_payload = 1 << 20;

std::string text(const std::vector<char>& bytes) { return {bytes.begin(), bytes.end()}; }

std::string hello() { return text(tcpq::greeting(tcpq::client_mark)); }

/// The first bytes of a publication that claims more than comes.
std::string claim(uint32_t name, uint32_t payload, const std::string& sent) {
  std::vector<char> bytes;
  tcpq::append_word(bytes, tcpq::publish);
  tcpq::append_word(bytes, name);
  bytes.insert(bytes.end(), std::min<size_t>(name, 1000), 'c');
  tcpq::append_word(bytes, payload);
  return text(bytes) + sent;
}

/// All events of a stream that comes in pieces of `piece` bytes.
std::vector<HubEvent> events_of(HubParser& parser, const std::string& stream, size_t piece) {
  std::vector<HubEvent> events;
  for (size_t at = 0; at < stream.size(); at += piece) {
    std::string_view bytes = std::string_view(stream).substr(at, piece);
    while (auto event = parser.next(bytes)) events.push_back(std::move(*event));
    if (parser.fault() == HubParser::Fault::none) {
      EXPECT_TRUE(bytes.empty());
    }
  }
  return events;
}

HubParser::Fault fault_of(const std::string& stream) {
  HubParser parser(max_name, max_payload);
  events_of(parser, stream, 7);
  return parser.fault();
}

TEST(HubParser, EventsDoNotDependOnHowTheBytesAreCut) {
  const std::string published = text(tcpq::publication("CHANNEL", std::string(1000, 'x')));
  const std::string stream = hello() + text(tcpq::subscription("A.*")) + published +
                             text(tcpq::publication("", "")) +
                             text(tcpq::subscription("A.*", tcpq::unsubscribe));
  for (const size_t piece :
       {size_t(1), size_t(2), size_t(3), size_t(9), size_t(500), stream.size()}) {
    HubParser parser(max_name, max_payload);
    const auto events = events_of(parser, stream, piece);
    ASSERT_EQ(events.size(), 5u) << piece;
    using Kind = HubEvent::Kind;
    EXPECT_EQ(events[0].kind, Kind::greeting);
    EXPECT_EQ(events[0].name(), "");
    EXPECT_EQ(events[1].kind, Kind::subscribe);
    EXPECT_EQ(events[1].name(), "A.*");
    EXPECT_EQ(events[2].kind, Kind::publish);
    EXPECT_EQ(events[2].name(), "CHANNEL");
    EXPECT_EQ(events[2].payload(), std::string(1000, 'x'));
    EXPECT_EQ(text(events[2].frame), published);
    EXPECT_EQ(events[3].kind, Kind::publish);
    EXPECT_EQ(events[3].name(), "");
    EXPECT_EQ(events[3].payload(), "");
    EXPECT_EQ(events[4].kind, Kind::unsubscribe);
    EXPECT_EQ(events[4].name(), "A.*");
    EXPECT_FALSE(parser.partial());
    EXPECT_EQ(parser.fault(), HubParser::Fault::none);
  }
}

TEST(HubParser, BytesAfterAnEventAreLeftForTheNextCall) {
  HubParser parser(max_name, max_payload);
  const std::string stream = hello() + text(tcpq::subscription("A")) + "rest";
  std::string_view bytes = stream;
  ASSERT_TRUE(parser.next(bytes));
  EXPECT_EQ(bytes.size(), stream.size() - 8);
  ASSERT_TRUE(parser.next(bytes));
  EXPECT_EQ(bytes, "rest");
}

TEST(HubParser, WhatLcmDoesNotSayIsAFault) {
  using Fault = HubParser::Fault;
  EXPECT_EQ(fault_of("GET / HTTP/1.1\r\n"), Fault::malformed);
  EXPECT_EQ(fault_of(text(tcpq::greeting(tcpq::server_mark))), Fault::malformed);
  for (const uint32_t type : {0u, 4u, 0xffffffffu})
    EXPECT_EQ(fault_of(hello() + text(tcpq::subscription("A", type))), Fault::malformed) << type;
}

TEST(HubParser, NothingFollowsAFault) {
  HubParser parser(max_name, max_payload);
  const std::string good = hello();
  EXPECT_TRUE(events_of(parser, "GET / HTTP/1.1\r\n" + good + good, 5).empty());
  EXPECT_EQ(parser.fault(), HubParser::Fault::malformed);
}

TEST(HubParser, LengthsAboveTheLimitsAreFaultsBeforeTheirBytesCome) {
  using Fault = HubParser::Fault;
  EXPECT_EQ(fault_of(hello() + claim(1, max_payload + 1, "")), Fault::too_large);
  EXPECT_EQ(fault_of(hello() + claim(1, 0xffffffff, "")), Fault::too_large);
  EXPECT_EQ(fault_of(hello() + claim(1, max_payload, "")), Fault::none);
  EXPECT_EQ(fault_of(hello() + claim(max_name + 1, 0, "")), Fault::too_large);
  EXPECT_EQ(fault_of(hello() + claim(0xffffffff, 0, "")), Fault::too_large);
  EXPECT_EQ(fault_of(hello() + claim(max_name, 0, "")), Fault::none);
  const std::string longest(max_name, 'p');
  EXPECT_EQ(fault_of(hello() + text(tcpq::subscription(longest))), Fault::none);
  EXPECT_EQ(fault_of(hello() + text(tcpq::subscription(longest + "p"))), Fault::long_pattern);
  EXPECT_EQ(fault_of(hello() + text(tcpq::subscription(longest + "p", tcpq::unsubscribe))),
            Fault::long_pattern);
}

TEST(HubParser, MemoryFollowsTheBytesThatCameAndNotTheirClaims) {
  HubParser parser(max_name, max_payload);
  const std::string stream = hello() + claim(1, max_payload, std::string(max_payload - 1, 'x'));
  size_t came = 0;
  for (size_t at = 0; at < stream.size(); at += 1000) {
    std::string_view bytes = std::string_view(stream).substr(at, 1000);
    came += bytes.size();
    while (parser.next(bytes)) {
    }
    EXPECT_LE(parser.held(), 4 * came + 64);
    EXPECT_LE(parser.held(), max_payload + 64);
  }
  EXPECT_TRUE(parser.partial());
  std::string_view last = "x";
  const auto event = parser.next(last);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->frame.size(), event->frame.capacity());  // nothing is held in vain
  EXPECT_EQ(parser.held(), 0u);
}

TEST(HubParser, AbandoningGivesTheMemoryBack) {
  HubParser parser(max_name, max_payload);
  const std::string stream = hello() + claim(1, max_payload, std::string(5000, 'x'));
  events_of(parser, stream, stream.size());
  EXPECT_GE(parser.held(), 5000u);
  parser.abandon();
  EXPECT_EQ(parser.held(), 0u);
  std::string_view more = "xxxx";
  EXPECT_FALSE(parser.next(more));
}

}  // namespace
}  // namespace genio
