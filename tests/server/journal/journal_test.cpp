#include "server/journal/journal.hpp"

#include "tests/runs/temporary_folder.hpp"
#include "tests/server/journal/journal_entries.hpp"

namespace genio {
namespace {

using test::as_made;
using test::entry_of;
using test::reply_of;

std::string id(unsigned k) { return entry_of(k, 0).id; }

class Journals : public testing::Test {
 protected:
  /// What is there after all objects are gone.
  Journal reopened() {
    journal.reset();
    return Journal(path);
  }
  test::TemporaryFolder folder;
  const std::string path = folder.path() + "/requests.journal";
  std::optional<Journal> journal{path};
};

TEST_F(Journals, WhatWasSyncedIsThereAgainWithEveryByte) {
  EXPECT_EQ(journal->accept(entry_of(1)), Acceptance::fresh);
  EXPECT_EQ(journal->accept(entry_of(2)), Acceptance::fresh);
  EXPECT_EQ(journal->tried(id(2)), 1);
  EXPECT_TRUE(journal->answered(id(2), reply_of(2), "converged", 77));
  journal->sync();
  Journal again = reopened();
  const auto first = again.find(id(1), Blobs::with), second = again.find(id(2), Blobs::with);
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(as_made(*first, 1));
  EXPECT_EQ(first->state, JournalState::accepted);
  EXPECT_TRUE(as_made(*second, 2));
  EXPECT_EQ(second->state, JournalState::answered);
  EXPECT_EQ(second->status, "converged");
  EXPECT_EQ(second->answered_us, 77);
  EXPECT_EQ(second->tries, 1);
  EXPECT_FALSE(again.delivered(id(2), 99, "somebody else"));
  EXPECT_TRUE(again.delivered(id(2), 99));
  again.sync();
  EXPECT_EQ(again.find(id(2))->delivered_us, 99);
}

TEST_F(Journals, WhatWasNotSyncedWasNeverPromised) {
  journal->accept(entry_of(1));
  journal->sync();
  journal->accept(entry_of(2));
  journal->answered(id(1), reply_of(1), "converged", 5);
  Journal again = reopened();
  EXPECT_EQ(again.find(id(1))->state, JournalState::accepted);
  EXPECT_FALSE(again.find(id(2)));
}

TEST_F(Journals, ChangesAreSeenBeforeTheyAreSynced) {
  journal->accept(entry_of(1));
  EXPECT_EQ(journal->unanswered().size(), 1u);
  journal->tried(id(1));
  EXPECT_EQ(journal->find(id(1))->tries, 1);
  journal->answered(id(1), reply_of(1), "failed", 5);
  EXPECT_TRUE(journal->unanswered().empty());
  EXPECT_EQ(journal->find(id(1), Blobs::with)->reply, reply_of(1));
  journal->delivered(id(1), 6);
  EXPECT_EQ(journal->counts().delivered, 1);
}

TEST_F(Journals, AnEntryIsReadWithoutItsBlobsWhereNobodyAskedForThem) {
  journal->accept(entry_of(1));
  journal->answered(id(1), reply_of(1), "converged", 5);
  const auto entry = journal->find(id(1));
  EXPECT_TRUE(entry->request.empty() && entry->reply.empty());
  EXPECT_EQ(entry->request_bytes, 6000);
  EXPECT_EQ(entry->reply_bytes, 10000);
  journal->accept(entry_of(2));
  EXPECT_TRUE(journal->unanswered(Blobs::without).front().request.empty());
}

TEST_F(Journals, AnIdStandsForOneContent) {
  journal->accept(entry_of(1));
  EXPECT_EQ(journal->accept(entry_of(1)), Acceptance::again);
  JournalEntry other = entry_of(1);
  other.digest[31] ^= 1;
  EXPECT_EQ(journal->accept(other), Acceptance::other);
  journal->answered(id(1), reply_of(1), "converged", 5);
  journal->sync();
  EXPECT_EQ(journal->accept(entry_of(1)), Acceptance::again);
  EXPECT_EQ(journal->accept(other), Acceptance::other);
  EXPECT_TRUE(as_made(*journal->find(id(1), Blobs::with), 1));
}

TEST_F(Journals, WhatIsUnansweredComesInTheOrderOfAcceptance) {
  for (const unsigned k : {5u, 3u, 9u, 1u}) journal->accept(entry_of(k));
  journal->answered(id(3), reply_of(3), "converged", 5);
  journal->sync();
  std::vector<std::string> ids;
  for (const JournalEntry& e : reopened().unanswered()) ids.push_back(e.id);
  EXPECT_EQ(ids, (std::vector{id(5), id(9), id(1)}));
}

TEST_F(Journals, ARequestIsAnsweredOnceAndDeliveredOnce) {
  EXPECT_FALSE(journal->answered(id(1), reply_of(1), "converged", 5));
  EXPECT_FALSE(journal->delivered(id(1), 6));
  journal->accept(entry_of(1));
  EXPECT_FALSE(journal->delivered(id(1), 6));
  EXPECT_TRUE(journal->answered(id(1), reply_of(1), "converged", 7));
  EXPECT_FALSE(journal->answered(id(1), reply_of(2), "failed", 8));
  EXPECT_TRUE(journal->delivered(id(1), 9));
  EXPECT_FALSE(journal->delivered(id(1), 10));
  const auto entry = journal->find(id(1), Blobs::with);
  EXPECT_TRUE(as_made(*entry, 1));
  EXPECT_EQ(entry->status, "converged");
  EXPECT_EQ(entry->delivered_us, 9);
}

TEST_F(Journals, TriesAreCountedAcrossRestarts) {
  EXPECT_EQ(journal->tried(id(1)), 0);
  journal->accept(entry_of(1));
  EXPECT_EQ(journal->tried(id(1)), 1);
  journal->sync();
  journal.emplace(reopened());
  EXPECT_EQ(journal->tried(id(1)), 2);
  journal->sync();
  EXPECT_EQ(reopened().find(id(1))->tries, 2);
}

TEST_F(Journals, IdsMayHoldAnyBytes) {
  JournalEntry odd = entry_of(1);
  odd.id = std::string("a\0b'\xff\n", 6), odd.client.clear(), odd.request.clear();
  JournalEntry alike = entry_of(2);
  alike.id = "a";
  journal->accept(odd), journal->accept(alike);
  journal->answered(odd.id, {}, "", 5);
  journal->sync();
  const auto entry = reopened().find(odd.id, Blobs::with);
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->id, odd.id);
  EXPECT_EQ(entry->state, JournalState::answered);
  EXPECT_TRUE(entry->request.empty() && entry->reply.empty() && entry->client.empty());
}

TEST_F(Journals, MessagesOfTheLargestSizeAreKept) {
  constexpr size_t large = 4u << 20;
  journal->accept(entry_of(1, large));
  journal->answered(id(1), reply_of(1, large), "converged", 5);
  journal->sync();
  EXPECT_TRUE(as_made(*reopened().find(id(1), Blobs::with), 1, large, large));
}

TEST_F(Journals, OneInMemoryWorksAlike) {
  Journal journal_there(":memory:");
  journal_there.accept(entry_of(1));
  journal_there.sync();
  journal_there.answered(id(1), reply_of(1), "converged", 5);
  journal_there.sync();
  EXPECT_TRUE(as_made(*journal_there.find(id(1), Blobs::with), 1));
  journal_there.prune(int64_t(1) << 60);
  EXPECT_FALSE(journal_there.find(id(1)));
  EXPECT_FALSE(std::filesystem::exists(":memory:"));
}

TEST(JournalLimit, NoMoreIsAcceptedThanMayWait) {
  Journal journal(":memory:", {.max_bytes = 20000});
  for (unsigned k = 1; k <= 3; ++k) EXPECT_EQ(journal.accept(entry_of(k)), Acceptance::fresh);
  EXPECT_EQ(journal.accept(entry_of(4)), Acceptance::full);
  EXPECT_EQ(journal.accept(entry_of(2)), Acceptance::again);
  journal.answered(id(1), reply_of(1), "converged", 5);
  EXPECT_EQ(journal.accept(entry_of(4)), Acceptance::fresh);
  EXPECT_EQ(journal.accept(entry_of(5)), Acceptance::full);
}

}  // namespace
}  // namespace genio
