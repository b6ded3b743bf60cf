// Requests that are withdrawn, or given up at the end.

#include <set>

#include "tests/server/dispatch/dispatch.hpp"

namespace genio {
namespace {

using test::Dispatch;

TEST_F(Dispatch, OnlyWhatWaitsOrRunsCanBeWithdrawn) {
  cancel("a"), ask("a"), next();
  EXPECT_TRUE(dispatcher.take_unwanted().empty());
  EXPECT_EQ(replies().at(0).reply.status, "refused");
  cancel("a"), cancel("a");
  EXPECT_EQ(dispatcher.take_unwanted(), std::vector<std::string>{"a"});
}

TEST_F(Dispatch, WhatWaitsIsWithdrawnAtOnce) {
  ask("a"), ask("b"), cancel("b");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].reply.id, "b");
  EXPECT_EQ(sent[0].reply.status, "cancelled");
  EXPECT_EQ(counts().queued, 1);
  // Asked again it was answered before.
  ask("b");
  EXPECT_EQ(replies().at(0).reply.status, "cancelled");
}

// Over UDP the reply to a withdrawal may be lost, and its client withdraws again.
TEST_F(Dispatch, WithdrawingTwiceIsAnsweredAlike) {
  ask("a"), cancel("a"), cancel("a"), cancel("a", "other");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 3u);
  EXPECT_EQ(sent[1].reply.status, "cancelled");
  EXPECT_EQ(sent[2].reply.status, "refused");
}

// Once anyone could cancel anyone's request.
TEST_F(Dispatch, OnlyTheClientThatAskedMayWithdraw) {
  ask("a", "one"), cancel("a", "two");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].client, "two");
  EXPECT_EQ(sent[0].reply.status, "refused");
  EXPECT_EQ(counts().queued, 1);
  cancel("a", "one");
  EXPECT_EQ(counts().queued, 0);
}

TEST_F(Dispatch, ClosingBeginsNothingAndAnswersAll) {
  ask("a"), next(), ask("b");
  dispatcher.close(), ask("c");
  EXPECT_EQ(next(), "");
  EXPECT_EQ(dispatcher.take_unwanted(), std::vector<std::string>{"a"});
  EXPECT_EQ(dispatcher.refuse_rest(), 2u);
  std::set<std::string> told;
  for (const auto& r : replies()) told.insert(r.reply.id);
  EXPECT_EQ(told, (std::set<std::string>{"a", "b", "c"}));
}

TEST_F(Dispatch, ThatARunningOneIsUnwantedIsToldOnceAndNotAfterItsEnd) {
  ask("a", "c", 1), ask("b", "c", 1), next(), next();
  cancel("a");
  EXPECT_EQ(dispatcher.take_unwanted(), std::vector<std::string>{"a"});
  cancel("b"), cancel("b"), answer("b", 1);
  dispatcher.pass_deadlines(now_us() + 2'000'000);
  EXPECT_TRUE(dispatcher.take_unwanted().empty());
}

TEST_F(Dispatch, AnIdIsNotComputedAgainWhileWhatWasGivenUpUnderItStillRuns) {
  ask("a"), next();
  dispatcher.drop("a", "the disk is full");
  replies();
  shape_request_t other{};
  other.id = "a", other.client = "c", other.label = "another question";
  ask(other);
  EXPECT_EQ(next(), "");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].reply.status, "refused");
  EXPECT_GT(sent[0].reply.retry_after_s, 0);
  answer("a", 1);
  EXPECT_TRUE(replies().empty());  // of the question that was given up
  ask(other);
  EXPECT_EQ(next(), "a");
}

}  // namespace
}  // namespace genio
