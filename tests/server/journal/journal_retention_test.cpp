#include <filesystem>

#include "forward/base/types.hpp"
#include "server/journal/journal_view.hpp"
#include "server/journal/prune_journal.hpp"
#include "tests/runs/temporary_folder.hpp"
#include "tests/server/journal/journal_entries.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;
using test::as_made;
using test::entry_of;
using test::reply_of;

std::string name(unsigned k) { return entry_of(k, 0).id; }

class Retention : public testing::Test {
 protected:
  /// Entries 0, 3, 6, ... are accepted, 1, 4, ... answered and 2, 5, ... delivered, at time k.
  void fill(Journal& journal, unsigned count) const {
    for (unsigned k = 0; k < count; ++k) {
      journal.accept(entry_of(k));
      if (k % 3) journal.answered(name(k), reply_of(k), "converged", k);
      if (k % 3 == 2) journal.delivered(name(k), 1000 - k);
    }
    journal.sync();
  }
  static std::vector<unsigned> left(const Journal& journal, unsigned count) {
    std::vector<unsigned> found;
    for (unsigned k = 0; k < count; ++k)
      if (journal.find(name(k))) found.push_back(k);
    return found;
  }
  static Pruned prune_to_the_end(Journal& journal, int64_t now) {
    Pruned all;
    do {
      const Pruned some = journal.prune(now);
      all.delivered += some.delivered, all.answered += some.answered, all.bytes += some.bytes;
      all.more = some.more;
    } while (all.more);
    return all;
  }
  test::TemporaryFolder folder;
  const std::string path = folder.path() + "/journal";
};

TEST_F(Retention, TimeTakesTheDeliveredThenTheAnsweredAndNeverTheRest) {
  Journal journal(path, {.keep_delivered_us = 100, .keep_answered_us = 200});
  fill(journal, 9);
  EXPECT_EQ(journal.prune(100).delivered, 0);
  EXPECT_EQ(journal.prune(103).delivered, 1);
  EXPECT_EQ(left(journal, 9), (std::vector{0u, 1u, 3u, 4u, 5u, 6u, 7u, 8u}));
  const Pruned later = journal.prune(205);
  EXPECT_EQ(later.delivered, 2);
  EXPECT_EQ(later.answered, 2);
  EXPECT_EQ(later.bytes, 4 * 16000);
  EXPECT_EQ(left(journal, 9), (std::vector{0u, 3u, 6u, 7u}));
  journal.prune(1'000'000);
  EXPECT_EQ(left(journal, 9), (std::vector{0u, 3u, 6u}));
}

TEST_F(Retention, SizeTakesTheOldestDeliveredFirst) {
  Journal journal(path, {.max_bytes = 400'000});
  fill(journal, 60);  // some 900 kB
  prune_to_the_end(journal, 0);
  const JournalCounts counts = journal.counts();
  EXPECT_EQ(counts.accepted, 20);
  EXPECT_EQ(counts.delivered, 0);
  EXPECT_GT(counts.answered, 5);
  EXPECT_LE(counts.file_bytes - counts.free_bytes, 400'000);
  EXPECT_TRUE(journal.find(name(58)));
  EXPECT_FALSE(journal.find(name(1)));
}

TEST_F(Retention, SizeLeavesTheAnsweredWhereTheDeliveredSuffice) {
  Journal journal(path, {.max_bytes = 700'000});
  fill(journal, 60);
  prune_to_the_end(journal, 0);
  const JournalCounts counts = journal.counts();
  EXPECT_EQ(counts.answered, 20);
  EXPECT_GT(counts.delivered, 3);
  EXPECT_FALSE(journal.find(name(2)));
  EXPECT_TRUE(journal.find(name(59)));
}

TEST_F(Retention, WhatIsUnansweredStaysHoweverMuchItIs) {
  Journal journal(path, {.max_bytes = 200'000});
  for (unsigned k = 0; k < 30; ++k) journal.accept(entry_of(k));
  journal.sync();
  journal.answered(name(0), reply_of(0), "converged", 1);
  prune_to_the_end(journal, int64_t(1) << 60);
  EXPECT_EQ(journal.unanswered().size(), 29u);
}

TEST_F(Retention, TheFileStaysBoundedOverALongService) {
  constexpr int64_t bound = 1'000'000;
  int64_t largest = 0;
  {
    Journal journal(path, {.max_bytes = bound});
    for (unsigned k = 0; k < 600; ++k) {
      journal.accept(entry_of(k));
      journal.answered(name(k), reply_of(k), "converged", k);
      if (k % 20 == 0) journal.prune(k);
      largest = std::max(largest, journal.counts().file_bytes);
    }
    journal.sync();
    prune_to_the_end(journal, 0);
    EXPECT_GT(journal.counts().answered, 30);
    EXPECT_LT(fs::file_size(path + "-wal"), 9'000'000u);
  }
  EXPECT_LT(largest, bound + 20 * 20'000 + bound / 8);
  EXPECT_LT(fs::file_size(path), uint64_t(bound + bound / 8));
}

TEST_F(Retention, ANumberIsNeverGivenTwice) {
  Journal journal(path);
  journal.accept(entry_of(1));
  journal.answered(name(1), {}, "failed", 1);
  const int64_t first = journal.find(name(1))->number;
  journal.prune(int64_t(1) << 60);
  journal.accept(entry_of(1));
  EXPECT_GT(journal.find(name(1))->number, first);
}

TEST_F(Retention, AnotherProgramPrunesBesideTheServer) {
  Journal journal(path);
  fill(journal, 60);
  const Pruned pruned = prune_journal(path, {.delivered_before_us = 30}, 7);
  EXPECT_EQ(pruned.delivered, 10);
  EXPECT_EQ(pruned.answered, 0);
  EXPECT_EQ(pruned.bytes, 10 * 16000);
  EXPECT_FALSE(journal.find(name(2)));
  EXPECT_TRUE(journal.find(name(32)) && journal.find(name(1)));
  EXPECT_EQ(journal.accept(entry_of(2)), Acceptance::fresh);  // as if it was never seen
  EXPECT_FALSE(journal.delivered(name(5), 7));
  journal.sync();
  EXPECT_EQ(journal.counts().free_bytes, 0);
}

TEST_F(Retention, WhatTheServerHasNotSyncedIsOutOfTheReachOfOthers) {
  Journal journal(path);
  fill(journal, 3);
  journal.answered(name(0), reply_of(0), "converged", 5);
  std::thread syncing([&] { usleep(200'000), journal.sync(); });  // the other one waits for it
  const Pruned pruned = prune_journal(path, {.answered_before_us = 100});
  syncing.join();
  EXPECT_EQ(pruned.answered, 2);
  EXPECT_EQ(journal.counts().accepted + journal.counts().answered, 0);
}

TEST_F(Retention, DeliveredOnlyHoldsForSizeToo) {
  {
    Journal journal(path);
    fill(journal, 30);
  }
  const Pruned pruned = prune_journal(path, {.keep_bytes = 1, .delivered_only = true});
  EXPECT_EQ(pruned.delivered, 10);
  EXPECT_EQ(pruned.answered, 0);
  EXPECT_EQ(prune_journal(path, {.keep_bytes = 1}).answered, 10);
  EXPECT_EQ(JournalView(path).counts().accepted, 10);
}

TEST_F(Retention, PruningShortensTheFile) {
  {
    Journal journal(path);
    fill(journal, 90);
  }
  const auto before = fs::file_size(path);
  prune_journal(path, {.answered_before_us = 1000});
  EXPECT_LT(fs::file_size(path), before * 3 / 4);
  Journal journal(path);
  for (const unsigned k : left(journal, 90))
    EXPECT_TRUE(as_made(*journal.find(name(k), Blobs::with), k));
}

}  // namespace
}  // namespace genio
