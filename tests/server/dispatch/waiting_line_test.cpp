#include "server/dispatch/waiting_line.hpp"

#include <gtest/gtest.h>

#include "server/dispatch/stream_states.hpp"
#include "server/dispatch/tally.hpp"

namespace genio {
namespace {

TEST(WaitingLine, CountsWhatWaits) {
  WaitingLine line;
  line.add({"a", 0, "", 10}), line.add({"b", 0, "s", 20});
  EXPECT_EQ(line.bytes(), 30u);
  EXPECT_EQ(line.ids(), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(line.remove("a"));
  EXPECT_FALSE(line.remove("a"));
  EXPECT_EQ(line.bytes(), 20u);
  EXPECT_FALSE(line.next({"s"}));
  EXPECT_EQ(line.next({})->id, "b");
  EXPECT_EQ(line.size(), 0u);
  EXPECT_EQ(line.bytes(), 0u);
}

TEST(WaitingLine, WhatComesBackStandsWhereItStood) {
  WaitingLine line;
  for (const char* id : {"1", "2", "3"}) line.add({id, 0, "s", 1});
  const auto first = line.next({});
  line.add(*first);
  EXPECT_EQ(line.ids(), (std::vector<std::string>{"1", "2", "3"}));
  EXPECT_EQ(line.next({})->id, "1");
}

TEST(WaitingLine, ClientsOfOnePriorityHaveTheirTurnsOneAfterAnother) {
  WaitingLine line;
  for (const char* id : {"1", "2", "3", "4"}) line.add({id, 0, "", 1, "many"});
  EXPECT_EQ(line.next({})->id, "1");
  line.add({"a", 0, "", 1, "few"}), line.add({"b", 0, "", 1, "few"});
  EXPECT_EQ(line.size_of("many"), 3u);
  EXPECT_EQ(line.ids(), (std::vector<std::string>{"2", "a", "3", "b", "4"}));
  line.add({"now", 1, "", 1, "many"});
  EXPECT_EQ(line.next({})->id, "now");
}

TEST(WaitingLine, WhoComesLaterDoesNotCatchUp) {
  WaitingLine line;
  for (const char* id : {"1", "2", "3", "4"}) line.add({id, 0, "", 1, "first"});
  line.next({}), line.next({});
  line.add({"a", 0, "", 1, "second"}), line.add({"b", 0, "", 1, "second"});
  EXPECT_EQ(line.ids(), (std::vector<std::string>{"3", "a", "4", "b"}));
}

TEST(StreamStates, TheLongestUnusedAreForgottenFirst) {
  StreamStates states(2, 100);
  states.keep("a", {1}), states.keep("b", {2}), states.keep("a", {3}), states.keep("c", {4});
  EXPECT_EQ(states.find("a"), std::vector<uint8_t>{3});
  EXPECT_TRUE(states.find("b").empty());
  states.keep("d", std::vector<uint8_t>(100, 9));
  EXPECT_TRUE(states.find("a").empty());
  EXPECT_TRUE(states.find("c").empty());
  EXPECT_EQ(states.find("d").size(), 100u);
  states.keep("d", {});
  EXPECT_TRUE(states.find("d").empty());
}

TEST(Tally, QuantilesAreOfTheLastThousand) {
  Tally tally;
  server_status_t s{};
  tally.tell(s);
  EXPECT_NE(s.latency_p50_s, s.latency_p50_s);
  for (int k = 0; k < 1000; ++k) tally.add_latency(1000);
  for (int k = 0; k < 1000; ++k) tally.add_latency(k);
  tally.tell(s);
  EXPECT_EQ(s.latency_p50_s, 500);
  EXPECT_EQ(s.latency_p90_s, 900);
  EXPECT_EQ(s.latency_p99_s, 990);
}

}  // namespace
}  // namespace genio
