// What a dispatcher tells those who watch the service.

#include <gtest/gtest.h>

#include "server/dispatch/dispatcher.hpp"

namespace genio {
namespace {

class DispatchNotes : public testing::Test {
 protected:
  void ask(const std::string& id, const std::string& client) {
    shape_request_t r{};
    r.id = id, r.client = client;
    const auto bytes = encode(r);
    dispatcher.receive_request(bytes.data(), bytes.size(), now_us());
  }
  Dispatcher dispatcher{{.waiting = 1}, {{"adult", "a1"}}};
};

TEST_F(DispatchNotes, AReplyIsNotedOnceWhoeverGetsIt) {
  ask("a", "first"), ask("a", "second");
  dispatcher.next(now_us());
  command_reply_t reply{};
  reply.status = "converged", reply.rms_mm = 0.5;
  dispatcher.finish("a", reply, {}, now_us());
  ask("a", "third");
  const auto notes = dispatcher.take_notes();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].client, "first");
  EXPECT_EQ(notes[0].reply.id, "a");
  EXPECT_EQ(notes[0].reply.model, "adult");
  EXPECT_EQ(notes[0].reply.rms_mm, 0.5);
  EXPECT_TRUE(dispatcher.take_notes().empty());
}

TEST_F(DispatchNotes, ARefusalIsNotedWithItsReason) {
  ask("a", "c"), ask("b", "c");
  const auto notes = dispatcher.take_notes();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].client, "c");
  EXPECT_EQ(notes[0].reply.id, "b");
  EXPECT_EQ(notes[0].reply.status, "refused");
  EXPECT_TRUE(notes[0].reply.message.starts_with("the queue is full"));
}

TEST_F(DispatchNotes, AMessageThatNobodyCanBeToldAboutIsNotedAndCounted) {
  const std::vector<uint8_t> junk(30, 0xff);
  cancel_t nobody{};
  nobody.id = "a", nobody.client = "no name!";
  const auto unusable = encode(nobody);
  dispatcher.receive_ack(junk.data(), junk.size());
  dispatcher.receive_cancel(junk.data(), junk.size(), now_us());
  dispatcher.receive_cancel(unusable.data(), unusable.size(), now_us());
  const auto drops = dispatcher.take_drops();
  ASSERT_EQ(drops.size(), 3u);
  EXPECT_STREQ(drops[0].channel, "GENIO_ACK");
  EXPECT_EQ(drops[0].bytes, 30u);
  EXPECT_FALSE(drops[0].reason.empty());
  EXPECT_STREQ(drops[1].channel, "GENIO_CANCEL");
  EXPECT_EQ(drops[2].reason, "the client's name cannot be used");
  EXPECT_TRUE(dispatcher.take_drops().empty());
  EXPECT_TRUE(dispatcher.take_outgoing().messages.empty());
  server_status_t s{};
  dispatcher.tell(s);
  EXPECT_EQ(s.unreadable, 3);
}

}  // namespace
}  // namespace genio
