// Another program that holds the journal delays what waits for it, within bounds, and nobody else.

#include "server/keeper.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <set>

#include "server/journal/sqlite/database.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

using std::chrono::seconds;
using std::chrono::steady_clock;

/// Another program that writes, until it is destroyed.
class OtherWriter {
 public:
  explicit OtherWriter(const std::string& path) : db_(path, Database::Open::existing) {
    db_.run("BEGIN IMMEDIATE");
  }

 private:
  Database db_;
};

std::string kept_id(int k) { return "request-" + std::to_string(k); }

Outgoing accepted_request(int k, size_t bytes = 100) {
  AcceptedRecord record{kept_id(k), "c", std::string(32, char(k)), {}, 1, 0};
  record.request.resize(bytes);
  Outgoing outgoing;
  outgoing.records.emplace_back(record);
  outgoing.messages.push_back({"GENIO_PROGRESS.c", {uint8_t(k)}, record.id});
  return outgoing;
}

OutgoingMessage reply_message(Passage passage) { return {"GENIO_REPLY.c", {1}, {}, passage}; }

class KeeperTest : public testing::Test {
 protected:
  /// What comes until `enough` says so, or a time that no machine needs.
  KeptBatch collect(const std::function<bool(const KeptBatch&)>& enough) {
    KeptBatch all;
    const auto end = steady_clock::now() + seconds(60);
    while (!enough(all) && steady_clock::now() < end) {
      pollfd polled{keeper->descriptor(), POLLIN, 0};
      poll(&polled, 1, 100);
      KeptBatch some = keeper->collect();
      all.messages.insert(all.messages.end(), some.messages.begin(), some.messages.end());
      all.unkept.insert(all.unkept.end(), some.unkept.begin(), some.unkept.end());
    }
    return all;
  }
  KeptBatch collect_all(int requests) {
    return collect([=](const KeptBatch& b) {
      return b.messages.size() + b.unkept.size() >= size_t(requests);
    });
  }
  void open(size_t most_bytes = 64u << 20) {
    keeper = std::make_unique<Keeper>(
        path, [](const std::string&) {}, most_bytes);
  }
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/journal";
  std::unique_ptr<Keeper> keeper;
};

TEST_F(KeeperTest, ALockOfAnotherProgramStallsABatchOnceAndNotEachRecord) {
  constexpr int requests = 20;
  open();
  keeper->hand_over(accepted_request(0));
  ASSERT_EQ(collect_all(1).messages.size(), 1u);
  auto other = std::make_unique<OtherWriter>(path);
  const auto begin = steady_clock::now();
  Outgoing batch;
  batch.records.emplace_back(AnsweredRecord{kept_id(0), "converged", {7}});
  for (int k = 1; k <= requests; ++k) {
    Outgoing one = accepted_request(k);
    batch.records.push_back(one.records.front());
    batch.messages.push_back(one.messages.front());
  }
  batch.messages.push_back(reply_message(Passage::in_order));
  keeper->hand_over(std::move(batch));
  const KeptBatch kept = collect_all(requests);
  EXPECT_LT(steady_clock::now() - begin, seconds(30));  // five a stall
  ASSERT_EQ(kept.unkept.size(), size_t(requests));
  EXPECT_NE(kept.unkept.front().reason.find("in use by another program"), std::string::npos);
  // Nobody is told what does not stand in the journal.
  EXPECT_TRUE(kept.messages.empty());
  // The reply waited, and is written without anything else to write.
  other.reset();
  EXPECT_EQ(collect_all(1).messages.size(), 1u);
  EXPECT_EQ(keeper->finish(steady_clock::now() + seconds(60)), "");
  ASSERT_TRUE(keeper->find(kept_id(0)));
  EXPECT_EQ(keeper->find(kept_id(0))->reply, std::vector<uint8_t>{7});
}

TEST_F(KeeperTest, WhatWaitsForTheJournalIsBoundedAndNothingAcceptedIsLost) {
  open(1000000);
  const auto other = std::make_unique<OtherWriter>(path);
  int requests = 0;
  while (!keeper->is_behind() && requests < 1000)
    keeper->hand_over(accepted_request(requests++, 100000));
  ASSERT_LT(requests, 12);
  // Who says no more than that goes on, what tells of no record passes, and the rest is left out.
  for (int k = 0; k < 100000; ++k) {
    Outgoing more;
    more.records.emplace_back(DeliveredRecord{kept_id(k)});
    more.messages.push_back(reply_message(Passage::if_room));
    keeper->hand_over(std::move(more));
  }
  Outgoing refusal;
  refusal.messages.push_back(reply_message(Passage::at_once));
  keeper->hand_over(std::move(refusal));
  EXPECT_EQ(keeper->collect().messages.size(), 1u);
  const KeptBatch kept = collect_all(requests);
  EXPECT_EQ(kept.messages.size() + kept.unkept.size(), size_t(requests));
  std::set<std::string> told;
  for (const Unkept& u : kept.unkept) told.insert(u.id);
  for (const OutgoingMessage& m : kept.messages) told.insert(m.acknowledges);
  EXPECT_EQ(told.size(), size_t(requests));
  EXPECT_FALSE(keeper->is_behind());
}

TEST_F(KeeperTest, ItsEndDoesNotWaitForTheLockOfAnotherProgram) {
  open();
  const auto other = std::make_unique<OtherWriter>(path);
  keeper->hand_over(accepted_request(1));
  const std::string given_up = keeper->finish(steady_clock::now() + std::chrono::milliseconds(50));
  EXPECT_NE(given_up.find("given up at the end"), std::string::npos) << given_up;
  const auto begin = steady_clock::now();
  for (int k = 2; k < 100; ++k) keeper->hand_over(accepted_request(k));
  keeper.reset();
  EXPECT_LT(steady_clock::now() - begin, seconds(30));
}

}  // namespace
}  // namespace genio
