// A disk that is full, or fails: new requests are refused, and nothing else is lost.

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "forward/base/types.hpp"
#include "tests/runs/temporary_folder.hpp"
#include "tests/server/journal/journal_entries.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;
using test::as_made;
using test::entry_of;
using test::reply_of;

constexpr int not_allowed = 77;

std::string name_of(unsigned k) { return entry_of(k, 0).id; }

/// Runs `body` in a process of its own, as it changes what holds for all of one. Its exit status.
int in_own_process(const std::function<void()>& body) {
  const pid_t child = fork();
  if (child == 0) {
    body();
    std::fflush(nullptr);
    _exit(testing::Test::HasFailure() ? 1 : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// What sync() refuses, which has to throw.
std::vector<std::string> refused_by_sync(Journal& journal, const std::string& why) {
  try {
    journal.sync();
  } catch (const JournalError& e) {
    EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    return e.refused();
  }
  ADD_FAILURE() << "the disk is full, and yet it was synced";
  return {};
}

void expect_lost_requests_only(const std::string& path, const std::string& why,
                               const std::function<void()>& fill,
                               const std::function<void()>& make_room) {
  {
    Journal journal(path);
    for (const unsigned k : {1u, 2u, 5u}) journal.accept(entry_of(k));
    journal.sync();
    fill();
    EXPECT_EQ(journal.accept(entry_of(3, 100'000)), Acceptance::fresh);
    EXPECT_TRUE(journal.answered(name_of(1), reply_of(1, 100'000), "converged", 5));
    EXPECT_EQ(journal.tried(name_of(5)), 1);
    EXPECT_EQ(refused_by_sync(journal, why), (std::vector{name_of(3)}));

    // It is used on: what was refused is unknown, and the reply is at hand.
    EXPECT_FALSE(journal.find(name_of(3)));
    EXPECT_EQ(journal.find(name_of(1), Blobs::with)->reply, reply_of(1, 100'000));
    EXPECT_EQ(journal.counts().accepted, 2);
    EXPECT_FALSE(journal.answered(name_of(1), reply_of(2), "failed", 6));
    EXPECT_TRUE(refused_by_sync(journal, why).empty());
    EXPECT_EQ(journal.accept(entry_of(4, 100'000)), Acceptance::fresh);
    EXPECT_TRUE(journal.delivered(name_of(1), 7));
    EXPECT_EQ(journal.tried(name_of(5)), 2);
    EXPECT_EQ(refused_by_sync(journal, why), (std::vector{name_of(4)}));
    EXPECT_EQ(journal.unanswered().size(), 2u);

    make_room();
    EXPECT_EQ(journal.accept(entry_of(3)), Acceptance::fresh);
    journal.sync();
  }
  const Journal again(path);
  const auto first = again.find(name_of(1), Blobs::with);
  EXPECT_TRUE(as_made(*first, 1, 6000, 100'000));
  EXPECT_EQ(first->state, JournalState::delivered);
  EXPECT_EQ(first->status, "converged");
  EXPECT_TRUE(as_made(*again.find(name_of(2), Blobs::with), 2));
  EXPECT_TRUE(as_made(*again.find(name_of(3), Blobs::with), 3));
  EXPECT_FALSE(again.find(name_of(4)));
  EXPECT_EQ(again.find(name_of(5))->tries, 2);
}

TEST(FailingDisks, AWriteThatFailsCostsWhatWasNotPromised) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/journal";
  EXPECT_EQ(in_own_process([&] {
              std::signal(SIGXFSZ, SIG_IGN);
              rlimit before{};
              getrlimit(RLIMIT_FSIZE, &before);
              expect_lost_requests_only(
                  path, path + ": cannot be read or written: ",
                  [&] {
                    const rlimit now{fs::file_size(path + "-wal") + 20'000, before.rlim_max};
                    setrlimit(RLIMIT_FSIZE, &now);
                  },
                  [&] { setrlimit(RLIMIT_FSIZE, &before); });
            }),
            0);
}

/// Makes `folder` a disk of its own for this process; ends the process where that is not allowed.
void mount_small_disk(const std::string& folder, const char* size) {
  const auto user = std::to_string(geteuid()), group = std::to_string(getegid());
  const bool root = geteuid() == 0;
  if (unshare(root ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) != 0) _exit(not_allowed);
  if (!root) {
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
  }
  if (mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("none", folder.c_str(), "tmpfs", 0, size) != 0)
    _exit(not_allowed);
}

void fill_up(const std::string& file) {
  std::signal(SIGPIPE, SIG_IGN);
  const int out = open(file.c_str(), O_WRONLY | O_CREAT, 0600);
  const std::vector<char> block(4096);
  while (write(out, block.data(), block.size()) > 0) {
  }
  close(out);
}

TEST(FailingDisks, AFullDiskCostsWhatWasNotPromised) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/journal", ballast = folder.path() + "/ballast";
  const int status = in_own_process([&] {
    mount_small_disk(folder.path(), "size=2m");
    expect_lost_requests_only(
        path, path + ": cannot be written: No space left on device", [&] { fill_up(ballast); },
        [&] { fs::remove(ballast); });
  });
  if (status == not_allowed) GTEST_SKIP() << "mounting is not allowed here";
  EXPECT_EQ(status, 0);
}

TEST(FailingDisks, ANewJournalOnAFullDiskIsRefused) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/journal", ballast = folder.path() + "/ballast";
  const int status = in_own_process([&] {
    mount_small_disk(folder.path(), "size=400k");
    fill_up(ballast);
    try {
      const Journal journal(path);
      ADD_FAILURE() << "there is no room for it";
    } catch (const InputError& e) {
      const std::string told = e.what();
      EXPECT_TRUE(told.starts_with(path + ": ") && told.ends_with("No space left on device"))
          << told;
    }
    EXPECT_FALSE(fs::exists(path));
    fs::remove(ballast);
    EXPECT_NO_THROW(Journal journal(path));
  });
  if (status == not_allowed) GTEST_SKIP() << "mounting is not allowed here";
  EXPECT_EQ(status, 0);
}

TEST(FailingDisks, ADiskThatIsOftenFullLosesNoPromise) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/journal", ballast = folder.path() + "/ballast";
  const int status = in_own_process([&] {
    mount_small_disk(folder.path(), "size=3m");
    std::mt19937 random(5);
    std::vector<unsigned> promised;
    std::optional<Journal> journal(path);
    int failures = 0;
    for (unsigned k = 0; k < 400; ++k) {
      if (k % 20 == 10) fill_up(ballast);
      if (k % 20 == 0) fs::remove(ballast);
      if (k % 50 == 45) fs::remove(ballast), journal.reset(), journal.emplace(path);
      try {
        journal->accept(entry_of(k, random() % 9000));
        journal->answered(name_of(k / 2), reply_of(k / 2, 3000), "converged", k + 1);
        journal->sync();
        promised.push_back(k);
      } catch (const JournalError&) {
        ++failures;
      }
      try {
        if (k > 100) journal->prune(int64_t(30) * 86'400'000'000 + k - 100);
      } catch (const JournalError&) {
      }
    }
    EXPECT_GT(failures, 20);
    EXPECT_GT(promised.size(), 100u);
    fs::remove(ballast);
    journal.reset();
    journal.emplace(path);
    for (const unsigned k : promised) {
      const auto entry = journal->find(name_of(k), Blobs::with);
      // Whatever was answered may be pruned; the second half never was.
      EXPECT_TRUE(entry || k < 200) << k;
      if (!entry) continue;
      EXPECT_EQ(entry->request, entry_of(k, size_t(entry->request_bytes)).request);
      EXPECT_TRUE(entry->state == JournalState::accepted || entry->reply == reply_of(k, 3000));
    }
  });
  if (status == not_allowed) GTEST_SKIP() << "mounting is not allowed here";
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace genio
