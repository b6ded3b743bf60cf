#include "server/hub/protocol/channel_pattern.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <regex>

#include "server/hub/protocol/subscriptions.hpp"

namespace genio {
namespace {

bool matches(std::string_view pattern, std::string_view channel) {
  const auto parsed = ChannelPattern::parse(pattern);
  EXPECT_TRUE(parsed) << pattern;
  return parsed && parsed->matches(channel);
}

bool needs_program(std::string_view pattern) {
  return ChannelPattern::parse(pattern).value().has_program();
}

TEST(ChannelPattern, MatchesWholeChannels) {
  EXPECT_TRUE(matches("GENIO_REPLY", "GENIO_REPLY"));
  EXPECT_FALSE(matches("GENIO_REPLY", "GENIO_REPLY.a"));
  EXPECT_FALSE(matches("GENIO_REPLY", "GENIO_REPL"));
  EXPECT_TRUE(matches("GENIO_REPLY.a-1", "GENIO_REPLY.a-1"));
  EXPECT_TRUE(matches("GENIO_.*", "GENIO_"));
  EXPECT_TRUE(matches("GENIO_.*", "GENIO_STATUS"));
  EXPECT_FALSE(matches("GENIO_.*", "XGENIO_"));
  EXPECT_TRUE(matches(".*", ""));
  EXPECT_TRUE(matches(".*_STATE", "ARM_STATE"));
  EXPECT_FALSE(matches(".*_STATE", "ARM_STATES"));
  EXPECT_TRUE(matches("(POSE|LIDAR)_[0-9]+", "LIDAR_12"));
  EXPECT_FALSE(matches("(POSE|LIDAR)_[0-9]+", "LIDAR_"));
  EXPECT_TRUE(matches("A|B.*", "A"));
  EXPECT_FALSE(matches("A|B", "AB"));
  EXPECT_TRUE(matches("", ""));
  EXPECT_FALSE(matches("", "A"));
}

TEST(ChannelPattern, NamesWithDotsNeedNoProgram) {
  for (const char* simple : {"", ".*", "GENIO_STATUS", "GENIO_REPLY.c12-0a", "GENIO_.*", "a..*"})
    EXPECT_FALSE(needs_program(simple)) << simple;
  for (const char* hard : {".*a", "a*", "a|b", "(a)", "a\\.b", "a.*.*", "[a]", "a?", "a{2}", "^a$"})
    EXPECT_TRUE(needs_program(hard)) << hard;
}

/// Any pattern in which dots are the only signs.
TEST(ChannelPattern, MatchingWithoutAProgramGivesWhatTheRegularExpressionGives) {
  std::mt19937 random(1);
  const auto any = [&](const char* letters, size_t count) {
    std::string text;
    for (size_t size = random() % 6; text.size() < size;) text += letters[random() % count];
    return text;
  };
  int found = 0;
  for (int k = 0; k < 5000; ++k) {
    const std::string pattern = any("ab.", 3) + (random() % 2 ? ".*" : "");
    const std::string channel = any("ab", 2);
    const bool expected = std::regex_match(channel, std::regex(pattern));
    EXPECT_FALSE(needs_program(pattern)) << pattern;
    EXPECT_EQ(matches(pattern, channel), expected) << pattern << ' ' << channel;
    found += expected;
  }
  EXPECT_GT(found, 500);
}

TEST(ChannelPattern, ChannelsAreBytes) {
  EXPECT_TRUE(matches("a.b", std::string("a\0b", 3)));
  EXPECT_TRUE(matches("(a|c).b",
                      "a\xff"
                      "b"));
  EXPECT_TRUE(matches("(a|c).b", "a\nb"));
  EXPECT_TRUE(matches("a.b", "a\nb"));
  EXPECT_FALSE(matches("(a|c).b",
                       "a\xc3\xa4"
                       "b"));  // two bytes
}

TEST(ChannelPattern, WhatIsNoExpressionOrTooCostlyIsRefused) {
  for (const char* bad :
       {"(", ")", "[", "*", "a**b(", "\\", "(?=a)b", "(a)\\1", "(?<!a)b", "a{2000}", "\\pL+",
        "\\\\\\PN", "[^\\p{Greek}]", "(a{30}){30}", ".{500}(a|b)"})
    EXPECT_FALSE(ChannelPattern::parse(bad)) << bad;
  EXPECT_TRUE(ChannelPattern::parse("\\\\p*"));  // a backslash and p
}

TEST(ChannelPattern, NoPatternTakesLongToMatchOrCompile) {
  std::string wide;
  for (int k = 0; k < 25; ++k) wide += ".*a.{9}|";
  const std::string channel = std::string(255, 'a') + "c";
  const auto start = std::chrono::steady_clock::now();
  for (const std::string& pattern :
       {std::string("(a*)*b"), std::string("(a|aa)+b"), std::string("(.*)*(.*)*(.*)*b"),
        "(" + wide + "b)*", std::string(".*a.{250}b"), std::string("(a?){60}a{60}")}) {
    const auto parsed = ChannelPattern::parse(pattern);
    if (!parsed) continue;  // refusing is as good
    for (int k = 0; k < 20; ++k) EXPECT_FALSE(parsed->matches(channel)) << pattern;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

TEST(HubSubscriptions, WantWhatAnyPatternMatches) {
  HubSubscriptions subscriptions(10, 10);
  EXPECT_FALSE(subscriptions.want("A"));
  EXPECT_TRUE(subscriptions.add("(A|B)"));
  EXPECT_TRUE(subscriptions.add("C"));
  EXPECT_TRUE(subscriptions.add("(D|E)"));
  for (const char* channel : {"A", "B", "C", "D", "E"})
    EXPECT_TRUE(subscriptions.want(channel)) << channel;
  EXPECT_FALSE(subscriptions.want("F"));
}

TEST(HubSubscriptions, APatternThatCameTwiceIsRemovedTwice) {
  HubSubscriptions subscriptions(10, 10);
  for (const char* pattern : {"A", "(B|C)"}) {
    subscriptions.add(pattern);
    subscriptions.add(pattern);
    subscriptions.remove(pattern);
    subscriptions.remove("other");
  }
  EXPECT_TRUE(subscriptions.want("A") && subscriptions.want("B"));
  EXPECT_GT(subscriptions.cost(), 0u);
  subscriptions.remove("A");
  subscriptions.remove("(B|C)");
  EXPECT_FALSE(subscriptions.want("A") || subscriptions.want("B"));
  EXPECT_EQ(subscriptions.size(), 0u);
  EXPECT_EQ(subscriptions.cost(), 0u);
}

TEST(HubSubscriptions, AreLimited) {
  HubSubscriptions subscriptions(5, 2);
  EXPECT_TRUE(subscriptions.add("(A)"));
  EXPECT_TRUE(subscriptions.add("(B)"));
  EXPECT_FALSE(subscriptions.add("(C)"));
  EXPECT_FALSE(subscriptions.add("("));
  for (const char* pattern : {"A", "B", "C"}) EXPECT_TRUE(subscriptions.add(pattern));
  EXPECT_FALSE(subscriptions.add("D"));
  subscriptions.remove("(A)");
  EXPECT_TRUE(subscriptions.add("(D)"));
}

}  // namespace
}  // namespace genio
