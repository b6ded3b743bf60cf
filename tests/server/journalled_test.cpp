#include "server/journalled.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "server/dispatch/dispatcher.hpp"
#include "server/wire/process_clock.hpp"
#include "server/wire/wire.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

/// One life of a server: its journal and its dispatcher.
struct Life {
  explicit Life(const std::string& path)
      : journal(path),
        view(path),
        dispatcher({}, {{"tongue", "h"}},
                   {[this](const std::string& id) { return known_request(view, id); }}) {
    for (const JournalEntry& entry : journal.unanswered())
      dispatcher.resume(accepted_record(entry), entry.tries, now_us());
  }
  void ask(const std::string& id, double sigma_mm = 0.5, const std::string& client = "c") {
    shape_request_t r{};
    r.id = id, r.client = client, r.default_sigma_mm = sigma_mm;
    const auto bytes = encode(r);
    dispatcher.receive_request(bytes.data(), bytes.size(), now_us());
  }
  void answer(const std::string& id, const char* status = "converged") {
    command_reply_t reply{};
    reply.id = id, reply.status = status, reply.rms_mm = 0.25;
    dispatcher.finish(id, reply, {}, now_us());
  }
  std::string next() {
    const auto assignment = dispatcher.next(now_us());
    return assignment ? assignment->id : "";
  }
  int queued() const {
    server_status_t s{};
    return dispatcher.tell(s), s.queued;
  }
  /// Keeps the records as the service does; the replies that may be published then.
  std::vector<command_reply_t> turn() {
    Outgoing outgoing = dispatcher.take_outgoing();
    EXPECT_TRUE(write_records(journal, outgoing.records, now_us()).unkept.empty());
    std::vector<command_reply_t> replies;
    for (const OutgoingMessage& m : outgoing.messages) {
      std::string why;
      if (!m.channel.starts_with("GENIO_REPLY.")) continue;
      const auto reply = decode_checked<command_reply_t>(m.bytes.data(), m.bytes.size(), why);
      EXPECT_TRUE(reply) << why;
      if (reply) replies.push_back(*reply);
    }
    return replies;
  }

  Journal journal;
  JournalView view;
  Dispatcher dispatcher;
};

class Journalled : public testing::Test {
 protected:
  void live() {
    life.reset();  // as a kill would: what was not kept is gone
    life = std::make_unique<Life>(folder.path() + "/journal");
  }
  const test::TemporaryFolder folder;
  std::unique_ptr<Life> life;
};

TEST_F(Journalled, WhatWasAcceptedIsTakenUpByTheNextServer) {
  live(), life->ask("a"), life->ask("b"), life->turn();
  live();
  EXPECT_EQ(life->queued(), 2);
  EXPECT_EQ(life->next(), "a");
  life->answer("a");
  ASSERT_EQ(life->turn().size(), 1u);
  live();
  EXPECT_EQ(life->next(), "b");
}

TEST_F(Journalled, WhatWasAnsweredIsNotComputedAgain) {
  live(), life->ask("a"), life->next(), life->answer("a"), life->turn();
  live(), life->ask("a", 0.5, "another");
  EXPECT_EQ(life->queued(), 0);
  const auto replies = life->turn();
  ASSERT_EQ(replies.size(), 1u);
  EXPECT_EQ(replies[0].rms_mm, 0.25);
  life->ask("a", 0.6);
  EXPECT_EQ(life->turn().at(0).status, "refused");
}

// A kill of the server is none of the request's faults.
TEST_F(Journalled, OnlyTheEndOfAWorkerCountsAsATry) {
  live(), life->ask("a"), life->turn();
  for (int kills = 0; kills < 3; ++kills) {
    ASSERT_EQ(life->next(), "a") << kills;
    life->turn(), live();
  }
  for (int tries = 0; tries < 2; ++tries) {
    ASSERT_EQ(life->queued(), 1) << tries;
    life->next(), life->dispatcher.lost("a", "killed", now_us());
    if (tries == 0) life->turn(), live();
  }
  EXPECT_EQ(life->turn().at(0).status, "failed");
  live(), life->ask("a");
  EXPECT_EQ(life->turn().at(0).status, "failed");
}

TEST_F(Journalled, WhatEndedTwoWorkersBeforeAKillIsAnsweredAsFailed) {
  live(), life->ask("a"), life->turn();
  life->next(), life->dispatcher.lost("a", "killed", now_us());
  life->turn(), live();
  life->next(), life->dispatcher.lost("a", "killed", now_us());
  live();  // before the second end stood on the disk
  EXPECT_EQ(life->queued(), 1);
  life->next(), life->dispatcher.lost("a", "killed", now_us()), life->turn();
  live();
  EXPECT_EQ(life->queued(), 0);
}

TEST_F(Journalled, AStopInGoodOrderIsNoTryAndRefusesNobody) {
  live(), life->ask("a"), life->ask("b"), life->turn();
  for (int stops = 0; stops < 3; ++stops) {
    ASSERT_EQ(life->next(), "a");
    life->turn();
    life->dispatcher.close();
    life->answer("a", "cancelled");
    EXPECT_EQ(life->dispatcher.refuse_rest(), 0u);
    EXPECT_TRUE(life->turn().empty());
    live();
    EXPECT_EQ(life->queued(), 2);
  }
}

TEST_F(Journalled, AnAcknowledgedReplyCountsAsDelivered) {
  live(), life->ask("a"), life->next(), life->answer("a"), life->turn();
  EXPECT_EQ(life->journal.counts().delivered, 0);
  ack_t ack{};
  ack.id = "a", ack.client = "c";
  const auto bytes = encode(ack);
  life->dispatcher.receive_ack(bytes.data(), bytes.size());
  life->turn();
  EXPECT_EQ(life->journal.counts().delivered, 1);
}

TEST(JournalTimes, ChangeClocksAndBackAndNoDeadlineStaysNone) {
  AcceptedRecord record{};
  record.accepted = 1000, record.deadline = 3000;
  const AcceptedRecord there = later(record, -700);
  EXPECT_EQ(there.accepted, 300);
  EXPECT_EQ(there.deadline, 2300);
  EXPECT_EQ(later(there, 700).deadline, 3000);
  EXPECT_GT(later(record, -5000).deadline, 0);  // passed long ago, and not none
  record.deadline = 0;
  EXPECT_EQ(later(record, -700).deadline, 0);
  EXPECT_EQ(later(record, 700).deadline, 0);
}

TEST(JournalTimes, TheClockOfAProcessBeginsAsTheWallClock) {
  const int64_t first = process_us();
  EXPECT_LE(first, process_us());
  EXPECT_NEAR(double(wall_lead_us()), 0, 1e9);  // unless somebody sets the clock meanwhile
}

}  // namespace
}  // namespace genio
