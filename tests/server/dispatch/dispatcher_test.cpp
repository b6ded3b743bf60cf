#include "server/dispatch/dispatcher.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

namespace genio {
namespace {

class Dispatch : public testing::Test {
 protected:
  void ask(const shape_request_t& r) {
    const auto bytes = encode(r);
    dispatcher.receive_request(bytes.data(), bytes.size(), now_us());
  }
  void ask(const std::string& id, const std::string& client = "c", double deadline_s = 0) {
    shape_request_t r{};
    r.id = id, r.client = client, r.deadline_s = deadline_s;
    ask(r);
  }
  void cancel(const std::string& id, const std::string& client = "c") {
    cancel_t c{};
    c.id = id, c.client = client;
    const auto bytes = encode(c);
    dispatcher.receive_cancel(bytes.data(), bytes.size(), now_us());
  }
  void answer(const std::string& id, double rms_mm) {
    command_reply_t reply{};
    reply.id = id, reply.status = "converged", reply.rms_mm = rms_mm;
    dispatcher.finish(id, reply, {}, now_us());
  }
  struct Reply {
    std::string client;
    command_reply_t reply;
  };
  /// Those that are to be published now.
  std::vector<Reply> replies() {
    std::vector<Reply> result;
    const std::string prefix = "GENIO_REPLY.";
    for (const OutgoingMessage& m : dispatcher.take_outgoing().messages) {
      if (!m.channel.starts_with(prefix)) continue;
      std::string why;
      const auto reply = decode_checked<command_reply_t>(m.bytes.data(), m.bytes.size(), why);
      EXPECT_TRUE(reply) << why;
      result.push_back({m.channel.substr(prefix.size()), reply.value()});
    }
    return result;
  }
  /// The id of the next request, which runs from now on; empty: there is none.
  std::string next() {
    const auto assignment = dispatcher.next(now_us());
    return assignment ? assignment->id : "";
  }
  server_status_t counts(const Dispatcher& of) const {
    server_status_t s{};
    return of.tell(s), s;
  }
  server_status_t counts() const { return counts(dispatcher); }
  const std::vector<ModelIdentity> models = {{"adult", "a1"}, {"child", "c1"}};
  Dispatcher dispatcher{{.waiting = 2, .remembered = 2}, models};
};

TEST_F(Dispatch, RequestsComeInTheOrderOfTheirArrival) {
  ask("a"), ask("b");
  EXPECT_EQ(next(), "a");
  EXPECT_EQ(next(), "b");
  EXPECT_EQ(next(), "");
}

TEST_F(Dispatch, ARepeatedIdIsAnsweredByTheReplyOfTheFirst) {
  ask("a"), next(), answer("a", 0.5), ask("a", "other");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[1].client, "other");
  EXPECT_EQ(sent[1].reply.rms_mm, 0.5);
  EXPECT_EQ(counts().queued, 0);
}

// Over UDP a long reply goes in parts, and a repeated one fills what is missing.
TEST_F(Dispatch, ARepeatedReplyIsTheSameToTheByte) {
  ask("a"), next(), answer("a", 0.5);
  const auto first = dispatcher.take_outgoing().messages.back();
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  ask("a");
  const auto second = dispatcher.take_outgoing().messages.back();
  EXPECT_EQ(first.channel, second.channel);
  EXPECT_EQ(first.bytes, second.bytes);
  std::string why;
  EXPECT_GT(decode_checked<command_reply_t>(second.bytes.data(), second.bytes.size(), why)->utime,
            0);
}

TEST_F(Dispatch, AllWhoAskTheSameGetTheReplyOnce) {
  ask("a", "one"), ask("a", "two"), ask("a", "one");
  EXPECT_EQ(counts().queued, 1);
  next(), answer("a", 1);
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[0].client, "one");
  EXPECT_EQ(sent[1].client, "two");
}

TEST_F(Dispatch, AFullQueueRefusesWithAReply) {
  ask("a"), ask("b"), ask("c");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].reply.id, "c");
  EXPECT_EQ(sent[0].reply.status, "refused");
  EXPECT_NE(sent[0].reply.message.find("the queue is full"), std::string::npos);
  EXPECT_GT(sent[0].reply.retry_after_s, 0);
  EXPECT_EQ(counts().refused, 1);
}

TEST_F(Dispatch, OnlyAsManyRepliesAreRememberedAsAskedFor) {
  for (const char* id : {"a", "b", "c"}) ask(id), next(), answer(id, 1);
  ask("a");
  EXPECT_EQ(counts().queued, 1);  // forgotten: it waits again
  ask("c");
  EXPECT_EQ(counts().queued, 1);
}

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

// Once the same id with other content got the first answer in silence.
TEST_F(Dispatch, AnIdIsOneQuestion) {
  shape_request_t r{};
  r.id = "a", r.client = "c", r.default_sigma_mm = 0.5, r.utime = 1;
  ask(r);
  r.utime = 2, r.client = "other";
  ask(r);  // another sending of the same
  EXPECT_TRUE(replies().empty());
  r.default_sigma_mm = 0.6;
  ask(r);
  EXPECT_EQ(replies().at(0).reply.status, "refused");
  next(), answer("a", 1);
  EXPECT_EQ(replies().size(), 2u);
  ask(r);
  EXPECT_EQ(replies().at(0).reply.status, "refused");
}

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

// Each of them would get every step and the reply.
TEST_F(Dispatch, OnlySoManyClientsWaitForOneRequest) {
  for (int k = 0; k < 20; ++k) ask("a", "c" + std::to_string(k));
  EXPECT_EQ(replies().size(), 4u);
  EXPECT_EQ(counts().refused, 4);
  next(), answer("a", 1);
  EXPECT_EQ(replies().size(), 16u);
}

TEST_F(Dispatch, WithoutADeadlineARequestComputesForSoLongAtMost) {
  ask("a"), ask("b", "c", 1e6);
  EXPECT_EQ(dispatcher.next(now_us())->deadline_s, DispatchLimits().longest_s);
  EXPECT_EQ(dispatcher.next(now_us())->deadline_s, DispatchLimits().longest_s);
}

// A queue of requests with names of megabytes once took 1.26 GB.
TEST_F(Dispatch, WhatWaitsIsBoundedInBytes) {
  Dispatcher small({.waiting = 100, .waiting_bytes = 5000}, models);
  shape_request_t r{};
  r.client = "c", r.point_count = 50;
  r.x_mm.resize(50), r.y_mm.resize(50), r.z_mm.resize(50), r.sigma_mm.resize(50);
  r.kind.resize(50);
  for (const char* id : {"a", "b", "c"}) {
    r.id = id;
    const auto bytes = encode(r);
    small.receive_request(bytes.data(), bytes.size(), now_us());
  }
  EXPECT_EQ(counts(small).queued, 2);
  EXPECT_EQ(counts(small).refused, 1);
  r.id = "d", r.kind[7] = std::string(100, 'k');
  ask(r);
  EXPECT_NE(replies().at(0).reply.message.find("point 8"), std::string::npos);
}

TEST_F(Dispatch, AnIdThatWouldForgeALogIsRefused) {
  ask("a\nb");
  ask("a\x1b[2J");
  for (const auto& r : replies()) EXPECT_EQ(r.reply.status, "refused");
  EXPECT_EQ(counts().queued, 0);
}

// 20 001 points were once refused on a channel that no client hears.
TEST_F(Dispatch, WhoeverSendsTooManyPointsIsTold) {
  shape_request_t r{};
  const size_t n = 20001;
  r.id = "big", r.client = "sender", r.point_count = int(n);
  r.x_mm.resize(n), r.y_mm.resize(n), r.z_mm.resize(n), r.sigma_mm.resize(n), r.kind.resize(n);
  ask(r);
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].client, "sender");
  EXPECT_EQ(sent[0].reply.id, "big");
  EXPECT_NE(sent[0].reply.message.find("20000"), std::string::npos) << sent[0].reply.message;
}

// By the layout of genio 0.4.0's command_reply_t, which such a client can read.
TEST_F(Dispatch, AClientOfAnEarlierVersionIsToldSo) {
  std::vector<uint8_t> old = {0x09, 0x6d, 0x07, 0x81, 0xa2, 0x21, 0x6e, 0x96};
  old.insert(old.end(), 8, 0);  // utime
  for (const std::string text : {"7", "old-client"}) {
    old.insert(old.end(), {0, 0, 0, uint8_t(text.size() + 1)});
    old.insert(old.end(), text.begin(), text.end());
    old.push_back(0);
  }
  dispatcher.receive_request(old.data(), old.size(), now_us());
  int told = 0;
  for (const OutgoingMessage& m : dispatcher.take_outgoing().messages) {
    EXPECT_EQ(m.channel, "GENIO_REPLY.old-client");
    const std::string bytes(m.bytes.begin(), m.bytes.end());
    told += bytes.find("newer than the client's") != std::string::npos &&
            bytes.find(std::string("failed\0", 7)) != std::string::npos;
  }
  EXPECT_EQ(told, 2);  // two versions of the reply went with that request
}

TEST_F(Dispatch, WhatCannotBeReadIsAnsweredToEverybody) {
  dispatcher.receive_request("xyz", 3, now_us());
  ask("a", "no spaces");
  ask("", "c");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 3u);
  EXPECT_EQ(sent[0].client, "undecodable");
  EXPECT_EQ(sent[1].client, "undecodable");
  EXPECT_EQ(sent[2].client, "c");
  EXPECT_EQ(counts().received, 3);
  EXPECT_EQ(counts().replied, 3);
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

TEST_F(Dispatch, AModelThatIsNotServedIsRefusedByName) {
  shape_request_t r{};
  r.id = "a", r.client = "c", r.model = "giant";
  ask(r);
  const auto sent = replies();
  EXPECT_EQ(sent.at(0).reply.status, "refused");
  EXPECT_NE(sent.at(0).reply.message.find("'giant'"), std::string::npos);
  EXPECT_NE(sent.at(0).reply.message.find("adult, child"), std::string::npos);
}

TEST_F(Dispatch, ARequestRunsOnTheModelItNamesAndTheReplySaysWhich) {
  shape_request_t r{};
  r.id = "a", r.client = "c", r.model = "child", r.label = "ba", r.time_s = 1.5, r.stream = "s";
  ask(r);
  EXPECT_EQ(dispatcher.next(now_us())->model, 1u);
  answer("a", 1);
  const command_reply_t reply = replies().at(0).reply;
  EXPECT_EQ(reply.model, "child");
  EXPECT_EQ(reply.model_hash, "c1");
  EXPECT_EQ(reply.label, "ba");
  EXPECT_EQ(reply.time_s, 1.5);
  EXPECT_EQ(reply.stream, "s");
  EXPECT_EQ(reply.tries, 1);
}

TEST_F(Dispatch, AWorkersEndCostsOneTryAndTwoAreAFailure) {
  ask("a");
  ASSERT_EQ(next(), "a");
  dispatcher.lost("a", "killed by signal 9", now_us());
  EXPECT_TRUE(replies().empty());
  ASSERT_EQ(next(), "a");
  dispatcher.lost("a", "killed by signal 11", now_us());
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].reply.status, "failed");
  EXPECT_NE(sent[0].reply.message.find("signal 11"), std::string::npos);
  EXPECT_EQ(next(), "");
}

TEST_F(Dispatch, WhatIsTriedAgainKeepsItsPlace) {
  ask("a"), ask("b"), next();
  dispatcher.lost("a", "killed", now_us());
  EXPECT_EQ(next(), "a");
}

class DispatchStream : public Dispatch {
 protected:
  void ask_frame(const std::string& id, const std::string& stream, const std::string& client = "c",
                 int priority = 0) {
    shape_request_t r{};
    r.id = id, r.client = client, r.stream = stream, r.priority = priority;
    const auto bytes = encode(r);
    line.receive_request(bytes.data(), bytes.size(), now_us());
  }
  std::optional<Assignment> next_frame() { return line.next(now_us()); }
  void end(const std::string& id, std::vector<uint8_t> state) {
    command_reply_t reply{};
    reply.status = "converged";
    line.finish(id, reply, std::move(state), now_us());
  }
  Dispatcher line{{}, models};
};

TEST_F(DispatchStream, FramesRunOneAfterAnotherWhileOthersPass) {
  ask_frame("1", "s"), ask_frame("2", "s"), ask_frame("x", "");
  EXPECT_EQ(next_frame()->id, "1");
  EXPECT_EQ(next_frame()->id, "x");
  EXPECT_FALSE(next_frame());
  end("1", {});
  EXPECT_EQ(next_frame()->id, "2");
}

TEST_F(DispatchStream, AFrameStartsWhereTheOneBeforeEnded) {
  ask_frame("1", "s"), ask_frame("2", "s"), ask_frame("3", "t"), ask_frame("4", "s", "other");
  EXPECT_TRUE(next_frame()->start.empty());
  end("1", {7});
  EXPECT_EQ(next_frame()->start, std::vector<uint8_t>{7});
  EXPECT_TRUE(next_frame()->start.empty());  // another stream
  EXPECT_TRUE(next_frame()->start.empty());  // another client
}

TEST_F(DispatchStream, HigherPrioritiesPassButNotWithinAStream) {
  ask_frame("low", "", "c", -1), ask_frame("1", "s"), ask_frame("2", "s", "c", 5);
  ask_frame("high", "", "c", 9);
  EXPECT_EQ(next_frame()->id, "high");
  EXPECT_EQ(next_frame()->id, "1");
  EXPECT_EQ(next_frame()->id, "low");
  end("1", {});
  EXPECT_EQ(next_frame()->id, "2");
}

TEST_F(Dispatch, ProgressGoesToThoseWhoAsked) {
  ask("a", "one"), ask("a", "two"), next();
  dispatcher.take_outgoing();
  dispatcher.report_progress("a", 3, 1);
  const auto sent = dispatcher.take_outgoing().messages;
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[0].channel, "GENIO_PROGRESS.one");
  std::string why;
  const auto p = decode_checked<progress_t>(sent[1].bytes.data(), sent[1].bytes.size(), why);
  ASSERT_TRUE(p) << why;
  EXPECT_EQ(p->iteration, 3);
  EXPECT_EQ(p->rms_mm, 1);
}

TEST_F(Dispatch, PrioritiesBeyondTheirRangeAreRefused) {
  for (const int priority :
       {11, -11, std::numeric_limits<int>::max(), std::numeric_limits<int>::min(), 10, -10}) {
    shape_request_t r{};
    r.id = std::to_string(priority), r.client = "c", r.priority = priority;
    ask(r);
    const auto sent = replies();
    if (std::abs(double(priority)) <= 10) {
      EXPECT_TRUE(sent.empty()) << priority;
    } else {
      ASSERT_EQ(sent.size(), 1u) << priority;
      EXPECT_NE(sent[0].reply.message.find("priority"), std::string::npos);
    }
  }
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
