// What a request gets when its time is over.

#include <cmath>

#include "tests/server/dispatch/dispatch.hpp"

namespace genio {
namespace {

using test::Dispatch;

TEST_F(Dispatch, TimeInTheQueueCountsAsTimeOfTheDeadline) {
  ask("a", "c", 0.2), ask("b", "c", 100);
  dispatcher.pass_deadlines(now_us());
  EXPECT_TRUE(replies().empty());
  dispatcher.pass_deadlines(now_us() + 200000);
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].reply.id, "a");
  EXPECT_EQ(sent[0].reply.status, "deadline");
  const auto b = dispatcher.next(now_us());
  EXPECT_EQ(b->id, "b");
  EXPECT_LE(b->deadline_s, 100);
  EXPECT_GT(b->deadline_s, 90);
}

TEST_F(Dispatch, AtItsDeadlineARequestGetsTheBestSoFarAndNothingAfterwards) {
  ask("a", "c", 0.2), next();
  for (const double rms : {3.0, 1.0, 2.0}) {
    command_reply_t so_far{};
    so_far.rms_mm = rms;
    dispatcher.keep_best("a", so_far);
  }
  dispatcher.pass_deadlines(now_us() + 200000);
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].reply.status, "deadline");
  EXPECT_EQ(sent[0].reply.rms_mm, 1);
  EXPECT_EQ(dispatcher.take_unwanted(), std::vector<std::string>{"a"});
  EXPECT_EQ(counts().running, 1);  // its worker has not ended yet
  answer("a", 0.5);
  EXPECT_TRUE(replies().empty());
  EXPECT_EQ(counts().running, 0);
}

TEST_F(Dispatch, AtItsDeadlineAWholeAnswerIsWorthMoreThanAStepOfTheNextStart) {
  ask("a", "c", 0.2), next();
  command_reply_t whole{}, step{};
  whole.rms_mm = 0.5, whole.verdict = "explained", whole.muscle_count = 1;
  whole.muscle = {"GGP"};
  for (auto* values : {&whole.force_N, &whole.max_force_N, &whole.sd_N, &whole.low_N, &whole.high_N,
                       &whole.acts, &whole.median_N, &whole.mean_N, &whole.information_bits})
    *values = {1};
  step = whole, step.rms_mm = 0.4, step.low_N = {std::nan("")}, step.verdict = "none";
  dispatcher.keep_best("a", step), dispatcher.keep_best("a", whole);
  dispatcher.keep_best("a", step);
  dispatcher.pass_deadlines(now_us() + 200000);
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].reply.status, "deadline");
  EXPECT_EQ(sent[0].reply.verdict, "explained");
  EXPECT_EQ(sent[0].reply.rms_mm, 0.5);
}

TEST_F(Dispatch, WithoutADeadlineARequestComputesForSoLongAtMost) {
  ask("a"), ask("b", "c", 1e6);
  EXPECT_EQ(dispatcher.next(now_us())->deadline_s, DispatchLimits().longest_s);
  EXPECT_EQ(dispatcher.next(now_us())->deadline_s, DispatchLimits().longest_s);
}

// The dispatcher's times need not be those of the wall clock, which anyone may set.
TEST_F(Dispatch, OnlyRepliesCarryTheTimeOfTheWallClock) {
  shape_request_t r{};
  r.id = "a", r.client = "c", r.deadline_s = 2;
  const auto bytes = encode(r);
  const int64_t began = 5'000'000, before = now_us();
  dispatcher.receive_request(bytes.data(), bytes.size(), began);
  EXPECT_NEAR(1e-6 * double(dispatcher.next_deadline() - began), 2, 0.1);
  dispatcher.pass_deadlines(began + 1'500'000);
  EXPECT_TRUE(replies().empty());
  dispatcher.pass_deadlines(began + 2'000'000);
  const auto passed = replies();
  ASSERT_EQ(passed.size(), 1u);
  EXPECT_EQ(passed[0].reply.status, "deadline");
  EXPECT_EQ(passed[0].reply.waited_s, 2);
  EXPECT_GE(passed[0].reply.utime, before);
}

}  // namespace
}  // namespace genio
