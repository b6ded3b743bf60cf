// A server that is killed at any moment.

#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <thread>

#include "tests/runs/temporary_folder.hpp"
#include "tests/server/journal/journal_entries.hpp"

namespace genio {
namespace {

using test::as_made;
using test::entry_of;
using test::reply_of;

enum Promise : uint32_t { was_accepted = 1, was_tried, was_answered, was_delivered };

/// What a server told after sync(), in order.
struct Told {
  uint32_t request, promise;
};

constexpr size_t request_bytes = 3000, reply_bytes = 5000;

/// Accepts and answers until it is killed, and tells what it has synced. Takes up what is left.
[[noreturn]] void serve_until_killed(const std::string& path, int told_to, unsigned first) {
  const JournalLimits limits{.max_bytes = 600'000};
  Journal journal(path, limits);
  const auto tell = [&](const std::vector<Told>& told) {
    journal.sync();
    const auto size = told.size() * sizeof(Told);
    if (write(told_to, told.data(), size) != ssize_t(size)) _exit(1);
  };
  std::vector<unsigned> waiting;
  for (const JournalEntry& e : journal.unanswered()) waiting.push_back(unsigned(e.accepted_us));
  for (unsigned& k : waiting) k -= 1'000'000;
  for (unsigned next = first;;) {
    std::vector<Told> told;
    for (unsigned i = 0; i < 1 + next % 4; ++i, ++next) {
      if (journal.accept(entry_of(next, request_bytes)) != Acceptance::fresh) _exit(2);
      waiting.push_back(next);
      told.push_back({next, was_accepted});
    }
    tell(told), told.clear();
    while (waiting.size() > 3) {
      const unsigned k = waiting.front();
      const std::string id = entry_of(k, 0).id;
      journal.tried(id);
      tell({{k, was_tried}});
      journal.answered(id, reply_of(k, reply_bytes), "converged", k + 1);
      waiting.erase(waiting.begin());
      told.push_back({k, was_answered});
      if (k % 2 && k > first) {
        journal.delivered(id, k + 2);
        told.push_back({k, was_delivered});
      }
    }
    tell(told);
    journal.prune(0);  // by size
  }
}

/// Whole messages that a killed process left in its pipe.
std::vector<Told> read_told(int from) {
  std::vector<uint8_t> all;
  uint8_t block[4096];
  for (ssize_t n; (n = read(from, block, sizeof block)) > 0;)
    all.insert(all.end(), block, block + n);
  std::vector<Told> told(all.size() / sizeof(Told));
  if (!told.empty()) std::memcpy(told.data(), all.data(), told.size() * sizeof(Told));
  return told;
}

/// Lets a server live and kills it; adds the most that it told of each request.
void live_and_die(const std::string& path, unsigned first, unsigned life_us,
                  std::map<unsigned, uint32_t>& promised) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t server = fork();
  if (server == 0) {
    close(ends[0]);
    serve_until_killed(path, ends[1], first);
  }
  close(ends[1]);
  std::thread killer([&] { usleep(life_us), kill(server, SIGKILL); });
  for (const auto& [k, promise] : read_told(ends[0])) promised[k] = std::max(promised[k], promise);
  killer.join();
  close(ends[0]);
  int status = 0;
  waitpid(server, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it ended by itself, with " << WEXITSTATUS(status);
}

/// On a disk a flush takes most of the time; in memory most kills fall between flushes.
class KilledServers : public testing::TestWithParam<std::string> {};

TEST_P(KilledServers, KeepEverythingThatTheyTold) {
  const test::TemporaryFolder folder(GetParam());
  const std::string path = folder.path() + "/journal";
  std::map<unsigned, uint32_t> promised;
  std::mt19937 random(3);
  int pruned = 0, kept = 0;
  for (unsigned life = 0; life < 12; ++life) {
    live_and_die(path, 100'000 * life, unsigned(20'000 + random() % 200'000), promised);
    const Journal journal(path);
    for (const auto& [k, promise] : promised) {
      const auto entry = journal.find(entry_of(k, 0).id, Blobs::with);
      ++(entry ? kept : pruned);
      if (!entry) {
        EXPECT_GE(promise, was_tried) << k;  // only what was answered is pruned
        continue;
      }
      EXPECT_TRUE(as_made(*entry, k, request_bytes, reply_bytes)) << k;
      EXPECT_GE(entry->tries, promise >= was_tried ? 1 : 0) << k;
      EXPECT_GE(entry->state, promise == was_delivered  ? JournalState::delivered
                              : promise == was_answered ? JournalState::answered
                                                        : JournalState::accepted)
          << k;
    }
    if (HasFailure()) FAIL() << "after life " << life;
  }
  EXPECT_GT(kept, 100);
  EXPECT_GT(pruned, 0);
  EXPECT_LT(std::filesystem::file_size(path), 1'000'000u);
  RecordProperty("promised", int(promised.size()));
}

INSTANTIATE_TEST_SUITE_P(OnDiskAndInMemory, KilledServers,
                         testing::Values(std::filesystem::temp_directory_path().string(),
                                         std::filesystem::exists("/dev/shm") ? "/dev/shm" : "."));

}  // namespace
}  // namespace genio
