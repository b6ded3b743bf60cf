// The power fails at any moment: what was not flushed to the disk is there in part, or not at all.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "tests/runs/temporary_folder.hpp"
#include "tests/server/journal/journal_entries.hpp"
#include "tests/server/journal/recorded_disk.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;
using test::as_made;
using test::entry_of;
using test::reply_of;

constexpr size_t kept_request = 3000, kept_reply = 5000;

/// Promised once `after` events had happened.
struct Promised {
  size_t after;
  unsigned request;
  JournalState state;
};

struct Recording {
  std::map<std::string, std::string> files;  // at its beginning
  std::vector<test::RecordedDisk::Event> events;
  std::vector<Promised> promises;
};

/// A server that accepts, answers and prunes, long enough for its log to be written back often.
Recording recorded_service(const std::string& path) {
  test::RecordedDisk disk;
  Journal journal(path, {.max_bytes = 500'000});
  journal.accept(entry_of(0, kept_request));
  journal.sync();
  Recording recording;
  for (const char* ending : {"", "-wal"})
    recording.files[path + ending] = test::content_of(path + ending);
  disk.events.clear();
  const auto promise = [&](unsigned k, JournalState state) {
    recording.promises.push_back({disk.events.size(), k, state});
  };
  for (unsigned k = 1; k < 700; ++k) {
    journal.accept(entry_of(k, kept_request));
    const unsigned before = k - 1;
    if (k % 5) {
      journal.tried(entry_of(before, 0).id);
      journal.answered(entry_of(before, 0).id, reply_of(before, kept_reply), "converged", k);
    }
    journal.sync();
    promise(k, JournalState::accepted);
    if (k % 5) promise(before, JournalState::answered);
    if (k % 10 == 1) journal.prune(0);
  }
  recording.events = disk.events;
  return recording;
}

TEST(PowerFailure, TakesNothingThatWasPromised) {
  const test::TemporaryFolder folder(test::memory_folder());  // flushes are recorded, not awaited
  const std::string path = folder.path() + "/journal";
  const Recording recording = recorded_service(path);
  const auto wrote_back = std::count_if(
      recording.events.begin(), recording.events.end(), [&](const test::RecordedDisk::Event& e) {
        return e.kind == test::RecordedDisk::Event::flush && e.file == path;
      });
  EXPECT_GE(wrote_back, 3);
  fs::remove(path + "-shm");

  std::mt19937 random(4);
  std::vector<size_t> cuts(300);
  for (size_t& cut : cuts) cut = random() % (recording.events.size() + 1);
  std::sort(cuts.begin(), cuts.end());
  test::FailingDisk disk(recording.files);
  size_t happened = 0, pruned = 0, kept = 0;
  for (const size_t cut : cuts) {
    for (; happened < cut; ++happened) disk.happens(recording.events[happened]);
    for (const auto& [file, bytes] : disk.without_power(random))
      std::ofstream(file, std::ios::binary) << bytes;
    std::map<unsigned, JournalState> promised;
    for (const Promised& p : recording.promises)
      if (p.after <= cut) promised[p.request] = p.state;

    std::optional<Journal> journal;
    ASSERT_NO_THROW(journal.emplace(path)) << "power failed after event " << cut;
    for (const auto& [k, state] : promised) {
      const auto entry = journal->find(entry_of(k, 0).id, Blobs::with);
      ++(entry ? kept : pruned);
      if (!entry) {
        EXPECT_NE(k % 5, 4u) << k << " was never answered";
        continue;
      }
      EXPECT_TRUE(as_made(*entry, k, kept_request, kept_reply)) << k;
      EXPECT_GE(entry->state, state) << k;
    }
    if (HasFailure()) FAIL() << "power failed after event " << cut;
  }
  EXPECT_GT(kept, 10'000u);
  EXPECT_GT(pruned, 1'000u);
}

}  // namespace
}  // namespace genio
