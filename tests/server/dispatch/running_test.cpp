// Which request runs next, on what, from where, and what a worker's end costs it.

#include "tests/server/dispatch/dispatch.hpp"

namespace genio {
namespace {

using test::Dispatch;

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
  EXPECT_TRUE(next_frame()->start.empty());  // another client
  EXPECT_EQ(next_frame()->start, std::vector<uint8_t>{7});
  EXPECT_TRUE(next_frame()->start.empty());  // another stream
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

}  // namespace
}  // namespace genio
