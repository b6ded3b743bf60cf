#include "server/request_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace genio {
namespace {

class Queue : public testing::Test {
 protected:
  void ask(const std::string& id, const std::string& client = "c") {
    shape_request_t r{};
    r.id = id, r.client = client;
    const auto bytes = encode(r);
    queue.receive_request(bytes.data(), bytes.size());
  }
  void cancel(const std::string& id) {
    cancel_t c{};
    c.id = id;
    const auto bytes = encode(c);
    queue.receive_cancel(bytes.data(), bytes.size());
  }
  void answer(const std::string& id, double rms_mm) {
    command_reply_t reply{};
    reply.id = id, reply.status = "converged", reply.rms_mm = rms_mm;
    queue.finish(id, reply);
  }
  struct Reply {
    std::string client;
    command_reply_t reply;
  };
  /// Those that are to be published now.
  std::vector<Reply> replies() {
    std::vector<Reply> result;
    const std::string prefix = "GENIO_REPLY.";
    for (const OutgoingMessage& m : queue.take_outgoing()) {
      if (!m.channel.starts_with(prefix)) continue;
      std::string why;
      const auto reply = decode_checked<command_reply_t>(m.bytes.data(), m.bytes.size(), why);
      EXPECT_TRUE(reply) << why;
      result.push_back({m.channel.substr(prefix.size()), reply.value()});
    }
    return result;
  }
  RequestQueue queue{{.waiting = 2, .remembered = 2}};
};

TEST_F(Queue, RequestsComeInTheOrderOfTheirArrival) {
  ask("a"), ask("b");
  EXPECT_EQ(queue.next()->id, "a");
  EXPECT_EQ(queue.next()->id, "b");
}

TEST_F(Queue, ARepeatedIdIsAnsweredByTheReplyOfTheFirst) {
  ask("a"), queue.next(), answer("a", 0.5), ask("a", "other");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[1].client, "other");
  EXPECT_EQ(sent[1].reply.rms_mm, 0.5);
  EXPECT_EQ(queue.counts().queued, 0);
}

TEST_F(Queue, AllWhoAskTheSameGetTheReplyOnce) {
  ask("a", "one"), ask("a", "two"), ask("a", "one");
  EXPECT_EQ(queue.counts().queued, 1);
  queue.next(), answer("a", 1);
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[0].client, "one");
  EXPECT_EQ(sent[1].client, "two");
}

TEST_F(Queue, AFullQueueRefusesWithAReply) {
  ask("a"), ask("b"), ask("c");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].reply.id, "c");
  EXPECT_EQ(sent[0].reply.status, "failed");
  EXPECT_NE(sent[0].reply.message.find("the queue is full"), std::string::npos);
  EXPECT_EQ(queue.counts().refused, 1);
}

TEST_F(Queue, OnlyAsManyRepliesAreRememberedAsAskedFor) {
  for (const char* id : {"a", "b", "c"}) ask(id), queue.next(), answer(id, 1);
  ask("a");
  EXPECT_EQ(queue.counts().queued, 1);  // forgotten: it waits again
  ask("c");
  EXPECT_EQ(queue.counts().queued, 1);
}

TEST_F(Queue, OnlyWhatWaitsOrRunsCanBeWithdrawn) {
  cancel("a"), ask("a"), queue.next();
  EXPECT_FALSE(queue.withdrawn("a"));
  cancel("a");
  EXPECT_TRUE(queue.withdrawn("a"));
  answer("a", 1);
  EXPECT_FALSE(queue.withdrawn("a"));
}

TEST_F(Queue, WhatCannotBeReadIsAnsweredToEverybody) {
  queue.receive_request("xyz", 3);
  ask("a", "no spaces");
  ask("", "c");
  const auto sent = replies();
  ASSERT_EQ(sent.size(), 3u);
  EXPECT_EQ(sent[0].client, "undecodable");
  EXPECT_EQ(sent[1].client, "undecodable");
  EXPECT_EQ(sent[2].client, "c");
  EXPECT_EQ(queue.counts().received, 3);
  EXPECT_EQ(queue.counts().replied, 3);
}

TEST_F(Queue, ClosingEndsTheWaitingAndAnswersAllThatWait) {
  std::thread computing([&] {
    while (queue.next()) {
    }
  });
  queue.close();
  computing.join();
  ask("a"), ask("b");
  queue.refuse_waiting();
  EXPECT_EQ(replies().size(), 2u);
  EXPECT_TRUE(queue.withdrawn("anything"));
}

TEST_F(Queue, ProgressGoesToThoseWhoAsked) {
  ask("a", "one"), ask("a", "two"), queue.next();
  queue.take_outgoing();
  queue.report_progress("a", 3, 1e-3);
  const auto sent = queue.take_outgoing();
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
