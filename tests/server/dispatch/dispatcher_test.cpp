// What is taken, what is refused, and what a repeated question gets.

#include <chrono>
#include <limits>
#include <thread>

#include "tests/server/dispatch/dispatch.hpp"

namespace genio {
namespace {

using test::Dispatch;

/// A dispatcher with a journal that knows nothing.
struct DispatchWithJournal {
  explicit DispatchWithJournal(const std::vector<ModelIdentity>& models)
      : dispatcher({}, models, {[](const std::string&) { return std::nullopt; }}) {}
  void acknowledge(const std::string& id, const std::string& client) {
    ack_t ack{};
    ack.id = id, ack.client = client;
    const auto bytes = encode(ack);
    dispatcher.receive_ack(bytes.data(), bytes.size());
  }
  Dispatcher dispatcher;
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

// Each of them would get every step and the reply.
TEST_F(Dispatch, OnlySoManyClientsWaitForOneRequest) {
  for (int k = 0; k < 20; ++k) ask("a", "c" + std::to_string(k));
  EXPECT_EQ(replies().size(), 4u);
  EXPECT_EQ(counts().refused, 4);
  next(), answer("a", 1);
  EXPECT_EQ(replies().size(), 16u);
}

// One client could fill the queue, and everybody else was refused.
TEST_F(Dispatch, TheLastPlacesAreForThoseOfWhomFewWait) {
  Dispatcher busy({.waiting = 40}, models);
  const auto ask_busy = [&](const std::string& id, const std::string& client) {
    shape_request_t r{};
    r.id = id, r.client = client, r.point_count = 1;
    r.x_mm = r.y_mm = r.z_mm = r.sigma_mm = {1}, r.kind = {"tip"};
    const auto bytes = encode(r);
    busy.receive_request(bytes.data(), bytes.size(), now_us());
  };
  for (int k = 0; k < 100; ++k) ask_busy("a" + std::to_string(k), "greedy");
  EXPECT_EQ(counts(busy).queued, 40);
  for (int k = 0; k < 5; ++k) ask_busy("b" + std::to_string(k), "modest");
  EXPECT_EQ(counts(busy).queued, 44);
  for (int k = 0; k < 30; ++k) ask_busy("c" + std::to_string(k), "m" + std::to_string(k));
  EXPECT_EQ(counts(busy).queued, 50);
}

TEST_F(Dispatch, AnAcknowledgementWithALongNameIsDropped) {
  DispatchWithJournal kept(models);
  kept.acknowledge(std::string(60000, 'x'), "c"), kept.acknowledge("a", "no name at all");
  EXPECT_TRUE(kept.dispatcher.take_outgoing().records.empty());
  EXPECT_EQ(counts(kept.dispatcher).unreadable, 2);
  kept.acknowledge("a", "c");
  const auto outgoing = kept.dispatcher.take_outgoing();
  ASSERT_EQ(outgoing.records.size(), 1u);
  EXPECT_EQ(std::get<DeliveredRecord>(outgoing.records[0]).client, "c");
}

// A queue of requests with names of megabytes once took 1.26 GB.
TEST_F(Dispatch, WhatWaitsIsBoundedInBytes) {
  Dispatcher small({.waiting = 100, .waiting_bytes = 4000}, models);
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

TEST_F(Dispatch, AModelThatIsNotServedIsRefusedByName) {
  shape_request_t r{};
  r.id = "a", r.client = "c", r.model = "giant";
  ask(r);
  const auto sent = replies();
  EXPECT_EQ(sent.at(0).reply.status, "refused");
  EXPECT_NE(sent.at(0).reply.message.find("'giant'"), std::string::npos);
  EXPECT_NE(sent.at(0).reply.message.find("adult, child"), std::string::npos);
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

TEST_F(Dispatch, WhileTheJournalIsBehindNothingIsTakenAndWhatWasTakenGoesOn) {
  ask("before");
  dispatcher.hold(true);
  ask("held");
  const auto refused = replies();
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].reply.id, "held");
  EXPECT_EQ(refused[0].reply.status, "refused");
  EXPECT_NE(refused[0].reply.message.find("journal"), std::string::npos);
  EXPECT_GT(refused[0].reply.retry_after_s, 0);
  EXPECT_EQ(next(), "before");
  answer("before", 1);
  EXPECT_EQ(replies().at(0).reply.status, "converged");
  dispatcher.hold(false);
  ask("held");
  EXPECT_TRUE(replies().empty());
  EXPECT_EQ(next(), "held");
}

}  // namespace
}  // namespace genio
