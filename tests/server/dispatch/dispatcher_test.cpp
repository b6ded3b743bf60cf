#include "server/dispatch/dispatcher.hpp"

#include <gtest/gtest.h>

#include <cmath>
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
    dispatcher.receive_cancel(bytes.data(), bytes.size());
  }
  void answer(const std::string& id, double rms_mm) {
    command_reply_t reply{};
    reply.id = id, reply.status = "converged", reply.rms_mm = rms_mm;
    dispatcher.finish(id, reply, 0.5);
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
  Dispatcher dispatcher{{.waiting = 2, .remembered = 2}};
};

TEST_F(Dispatch, RequestsComeInTheOrderOfTheirArrival) {
  ask("a"), ask("b");
  EXPECT_EQ(dispatcher.next()->request.id, "a");
  EXPECT_EQ(dispatcher.next()->request.id, "b");
}

TEST_F(Dispatch, ARepeatedIdIsAnsweredByTheReplyOfTheFirst) {
  ask("a"), dispatcher.next(), answer("a", 0.5), ask("a", "other");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[1].client, "other");
  EXPECT_EQ(sent[1].reply.rms_mm, 0.5);
  EXPECT_EQ(dispatcher.counts().queued, 0);
}

// Over UDP a long reply goes in parts, and a repeated one fills what is missing.
TEST_F(Dispatch, ARepeatedReplyIsTheSameToTheByte) {
  ask("a"), dispatcher.next(), answer("a", 0.5);
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
  EXPECT_EQ(dispatcher.counts().queued, 1);
  dispatcher.next(), answer("a", 1);
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
  EXPECT_EQ(dispatcher.counts().refused, 1);
}

TEST_F(Dispatch, OnlyAsManyRepliesAreRememberedAsAskedFor) {
  for (const char* id : {"a", "b", "c"}) ask(id), dispatcher.next(), answer(id, 1);
  ask("a");
  EXPECT_EQ(dispatcher.counts().queued, 1);  // forgotten: it waits again
  ask("c");
  EXPECT_EQ(dispatcher.counts().queued, 1);
}

TEST_F(Dispatch, OnlyWhatWaitsOrRunsCanBeWithdrawn) {
  cancel("a"), ask("a"), dispatcher.next();
  EXPECT_FALSE(dispatcher.withdrawn("a"));
  EXPECT_EQ(replies().at(0).reply.status, "refused");
  cancel("a");
  EXPECT_TRUE(dispatcher.withdrawn("a"));
}

TEST_F(Dispatch, WhatWaitsIsWithdrawnAtOnce) {
  ask("a"), ask("b"), cancel("b");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].reply.id, "b");
  EXPECT_EQ(sent[0].reply.status, "cancelled");
  EXPECT_EQ(dispatcher.counts().queued, 1);
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
  EXPECT_EQ(dispatcher.counts().queued, 1);
  cancel("a", "one");
  EXPECT_EQ(dispatcher.counts().queued, 0);
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
  dispatcher.next(), answer("a", 1);
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
  const auto next = dispatcher.next();
  EXPECT_EQ(next->request.id, "b");
  EXPECT_LE(next->deadline_s, 100);
  EXPECT_GT(next->deadline_s, 90);
}

TEST_F(Dispatch, AtItsDeadlineARequestGetsTheBestSoFarAndNothingAfterwards) {
  ask("a", "c", 0.2), dispatcher.next();
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
  EXPECT_TRUE(dispatcher.withdrawn("a"));
  answer("a", 0.5);
  EXPECT_TRUE(replies().empty());
  EXPECT_EQ(dispatcher.counts().running, 0);
}

TEST_F(Dispatch, AtItsDeadlineAWholeAnswerIsWorthMoreThanAStepOfTheNextStart) {
  ask("a", "c", 0.2), dispatcher.next();
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

// A queue of requests with names of megabytes once took 1.26 GB.
TEST_F(Dispatch, WhatWaitsIsBoundedInBytes) {
  Dispatcher small({.waiting = 100, .waiting_bytes = 5000});
  shape_request_t r{};
  r.client = "c", r.point_count = 50;
  r.x_mm.resize(50), r.y_mm.resize(50), r.z_mm.resize(50), r.sigma_mm.resize(50);
  r.kind.resize(50);
  for (const char* id : {"a", "b", "c"}) {
    r.id = id;
    const auto bytes = encode(r);
    small.receive_request(bytes.data(), bytes.size(), now_us());
  }
  EXPECT_EQ(small.counts().queued, 2);
  EXPECT_EQ(small.counts().refused, 1);
  r.id = "d", r.kind[7] = std::string(100, 'k');
  ask(r);
  EXPECT_NE(replies().at(0).reply.message.find("point 8"), std::string::npos);
}

TEST_F(Dispatch, AnIdThatWouldForgeALogIsRefused) {
  ask("a\nb");
  ask("a\x1b[2J");
  for (const auto& r : replies()) EXPECT_EQ(r.reply.status, "refused");
  EXPECT_EQ(dispatcher.counts().queued, 0);
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
  EXPECT_EQ(dispatcher.counts().received, 3);
  EXPECT_EQ(dispatcher.counts().replied, 3);
}

TEST_F(Dispatch, ClosingEndsTheWaitingAndAnswersAllThatWait) {
  std::thread computing([&] {
    while (dispatcher.next()) {
    }
  });
  dispatcher.close();
  computing.join();
  ask("a"), ask("b");
  dispatcher.refuse_waiting();
  EXPECT_EQ(replies().size(), 2u);
  EXPECT_TRUE(dispatcher.withdrawn("anything"));
}

TEST_F(Dispatch, ProgressGoesToThoseWhoAsked) {
  ask("a", "one"), ask("a", "two"), dispatcher.next();
  dispatcher.take_outgoing();
  dispatcher.report_progress("a", 3, 1e-3);
  const auto sent = dispatcher.take_outgoing().messages;
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[0].channel, "GENIO_PROGRESS.one");
  std::string why;
  const auto p = decode_checked<progress_t>(sent[1].bytes.data(), sent[1].bytes.size(), why);
  ASSERT_TRUE(p) << why;
  EXPECT_EQ(p->iteration, 3);
  EXPECT_EQ(p->rms_mm, 1);
}

}  // namespace
}  // namespace genio
