// A damaged journal is refused in words, or gives what it was given; never anything else.

#include <filesystem>
#include <fstream>
#include <sstream>

#include "forward/base/types.hpp"
#include "server/journal/journal_view.hpp"
#include "server/journal/prune_journal.hpp"
#include "tests/runs/temporary_folder.hpp"
#include "tests/server/journal/journal_entries.hpp"

namespace genio {
namespace {

using test::as_made;
using test::entry_of;
using test::reply_of;

constexpr unsigned entry_count = 24;
constexpr size_t request_size = 900, reply_size = 5000;

void write_all(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void fill(Journal& journal) {
  for (unsigned k = 0; k < entry_count; ++k) {
    journal.accept(entry_of(k, request_size));
    if (k % 3) journal.answered(entry_of(k, 0).id, reply_of(k, reply_size), "converged", k);
    if (k % 3 == 2) journal.delivered(entry_of(k, 0).id, k);
    if (k % 4 == 3) journal.sync();
  }
  journal.sync();
}

/// One that was closed, and one of a server that was killed, whose log still holds everything.
struct Whole {
  std::string file, log;
};

Whole whole_journal(bool closed) {
  const test::TemporaryFolder folder(test::memory_folder());
  const std::string path = folder.path() + "/journal";
  Journal journal(path);
  fill(journal);
  if (closed) Journal moved(std::move(journal));
  return {test::content_of(path), closed ? "" : test::content_of(path + "-wal")};
}

std::string damaged(std::string bytes, std::mt19937& random) {
  const auto below = [&](size_t n) { return size_t(random() % n); };
  const size_t at = below(bytes.size());
  switch (random() % 5) {
    case 0:  // cut off
      bytes.resize(1 + at);
      break;
    case 1: {  // a block of zeros or of noise
      const size_t size = std::min(bytes.size() - at, 1 + below(9000));
      const bool zeros = random() % 2;
      for (size_t k = at; k < at + size; ++k) bytes[k] = zeros ? '\0' : char(random());
      break;
    }
    case 2: {  // two pages in each other's place
      const size_t pages = bytes.size() / 4096;
      const size_t a = below(pages), b = below(pages);
      std::swap_ranges(bytes.begin() + long(4096 * a), bytes.begin() + long(4096 * (a + 1)),
                       bytes.begin() + long(4096 * b));
      if (a == b) bytes[4096 * a] = char(bytes[4096 * a] ^ 0x40);
      break;
    }
    case 3:  // some bytes
      for (int k = 0; k < 20; ++k) bytes[below(bytes.size())] = char(random());
      break;
    default:  // one bit
      bytes[at] = char(bytes[at] ^ (1 << random() % 8));
  }
  return bytes;
}

/// What a damaged journal may do: refuse, or give what it was given. Gives what was refused.
enum class Found { whole, opened_and_refused, refused };

/// Reads everything; `missing_allowed` where a cut log may have taken the last entries with it.
Found reads_right(const std::string& path, bool missing_allowed) {
  try {
    Journal journal(path);
    bool refused = false;
    for (unsigned k = 0; k < entry_count; ++k) try {
        const auto entry = journal.find(entry_of(k, 0).id, Blobs::with);
        if (entry) EXPECT_TRUE(as_made(*entry, k, request_size, reply_size)) << k;
        else EXPECT_TRUE(missing_allowed) << k;
      } catch (const JournalError& e) {
        EXPECT_EQ(std::string(e.what()).find(path + ": is damaged"), 0u) << e.what();
        refused = true;
      }
    try {
      for (const JournalEntry& e : journal.unanswered())
        EXPECT_TRUE(as_made(e, unsigned(e.accepted_us - 1'000'000), request_size, reply_size));
      journal.accept(entry_of(entry_count, request_size));
      journal.prune(int64_t(1) << 60);
      journal.sync();
    } catch (const JournalError&) {
      refused = true;
    }
    return refused ? Found::opened_and_refused : Found::whole;
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find(path + ": "), 0u) << e.what();
    return Found::refused;
  }
}

void read_as_others(const std::string& path) {
  try {
    const JournalView view(path);
    view.counts();
    view.each(Blobs::with, [](const JournalEntry& e, const std::string& damage) {
      const auto k = unsigned(e.accepted_us - 1'000'000);
      EXPECT_TRUE(!damage.empty() || as_made(e, k, request_size, reply_size)) << k;
    });
  } catch (const InputError&) {
  }
  try {
    prune_journal(path, {.delivered_before_us = 10});
  } catch (const InputError&) {
  }
}

TEST(DamagedJournals, TheFileIsRefusedOrReadRight) {
  const Whole whole = whole_journal(true);
  ASSERT_GT(whole.file.size(), 130'000u);
  std::mt19937 random(1);
  std::map<Found, int> found;
  for (int trial = 0; trial < 500; ++trial) {
    const test::TemporaryFolder folder(test::memory_folder());
    const std::string path = folder.path() + "/journal", copy = folder.path() + "/copy";
    const std::string bytes = damaged(whole.file, random);
    write_all(path, bytes), write_all(copy, bytes);
    ++found[reads_right(path, false)];
    read_as_others(copy);
    if (HasFailure()) FAIL() << "in trial " << trial;
  }
  // Most damage is found when the file is opened, that of replies when they are asked for, and what
  // fell on unused bytes never.
  EXPECT_GT(found[Found::refused], 250);
  EXPECT_GT(found[Found::opened_and_refused], 10);
  EXPECT_GT(found[Found::whole], 5);
  RecordProperty("refused", found[Found::refused]);
  RecordProperty("refused_later", found[Found::opened_and_refused]);
  RecordProperty("whole", found[Found::whole]);
}

TEST(DamagedJournals, ADamagedLogCostsTheLastEntriesButMakesNoWrongOne) {
  const Whole whole = whole_journal(false);
  ASSERT_GT(whole.log.size(), 100'000u);
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const test::TemporaryFolder folder(test::memory_folder());
    const std::string path = folder.path() + "/journal", copy = folder.path() + "/copy";
    const std::string log = damaged(whole.log, random);
    for (const std::string& name : {path, copy})
      write_all(name, whole.file), write_all(name + "-wal", log);
    reads_right(path, true);
    read_as_others(copy);
    if (HasFailure()) FAIL() << "in trial " << trial;
  }
}

TEST(DamagedJournals, TheWholeOneIsReadRight) {
  for (const bool closed : {true, false}) {
    const Whole whole = whole_journal(closed);
    const test::TemporaryFolder folder(test::memory_folder());
    const std::string path = folder.path() + "/journal";
    write_all(path, whole.file);
    if (!closed) write_all(path + "-wal", whole.log);
    EXPECT_EQ(reads_right(path, false), Found::whole);
  }
}

TEST(DamagedJournals, AReplyThatIsDamagedCostsNoOtherRequest) {
  const test::TemporaryFolder folder(test::memory_folder());
  const std::string path = folder.path() + "/journal";
  {
    Journal journal(path);
    journal.accept(entry_of(1, request_size));
    journal.answered("request-1", reply_of(1, reply_size), "converged", 5);
    journal.sync();
  }
  std::string bytes = test::content_of(path);
  const auto reply = reply_of(1, reply_size);
  const auto at = bytes.find(std::string(reply.begin(), reply.begin() + 100));
  ASSERT_NE(at, std::string::npos);
  bytes[at] = char(bytes[at] ^ 1);
  write_all(path, bytes);
  {
    Journal journal(path);
    journal.accept(entry_of(2, request_size));
    EXPECT_THROW(journal.find("request-1", Blobs::with), JournalError);
    EXPECT_TRUE(journal.find("request-1"));
    journal.sync();
  }
  EXPECT_TRUE(as_made(*Journal(path).find("request-2", Blobs::with), 2, request_size));
}

TEST(DamagedJournals, EveryByteOfARequestThatWaitsCountsAtOpening) {
  const test::TemporaryFolder folder(test::memory_folder());
  const std::string path = folder.path() + "/journal";
  {
    Journal journal(path);
    journal.accept(entry_of(7, request_size));
    journal.sync();
  }
  std::string bytes = test::content_of(path);
  const auto request = entry_of(7, request_size).request;
  const auto at = bytes.find(std::string(request.begin(), request.end()));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 500] = char(bytes[at + 500] ^ 1);
  write_all(path, bytes);
  EXPECT_EQ(reads_right(path, false), Found::refused);
}

}  // namespace
}  // namespace genio
