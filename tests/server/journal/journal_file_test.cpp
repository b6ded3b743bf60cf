// What stands in the place of a journal: it is refused in words, or brought up to date.

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"
#include "server/journal/journal_view.hpp"
#include "server/journal/open_journal.hpp"
#include "server/journal/prune_journal.hpp"
#include "server/journal/schema.hpp"
#include "tests/runs/temporary_folder.hpp"
#include "tests/server/journal/journal_entries.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;
using test::entry_of;

class JournalFiles : public testing::Test {
 protected:
  void make() const {
    Journal journal(path);
    journal.accept(entry_of(1));
    journal.sync();
  }
  void change(const std::string& sql) const { Database(path, Database::Open::existing).run(sql); }
  /// What the server, a reader and a pruner are told.
  std::vector<std::string> refusals() const {
    std::vector<std::string> told;
    for (const auto& open : std::initializer_list<std::function<void()>>{
             [&] { const Journal journal(path); }, [&] { const JournalView view(path); },
             [&] { prune_journal(path, {}); }}) {
      try {
        open();
        told.push_back("");
      } catch (const InputError& e) {
        told.push_back(e.what());
      }
    }
    return told;
  }
  void expect_refused(const std::string& why) const {
    for (const std::string& told : refusals()) {
      EXPECT_EQ(told.find(path + ": "), 0u) << told;
      EXPECT_NE(told.find(why), std::string::npos) << told << "; expected " << why;
    }
  }
  test::TemporaryFolder folder;
  const std::string path = folder.path() + "/requests.journal";
};

TEST_F(JournalFiles, AnotherFileIsNoJournal) {
  write_text(path, std::string(9000, 'x'));
  expect_refused("is no journal of Genio");
  EXPECT_FALSE(fs::exists(path + ".lock"));
}

TEST_F(JournalFiles, AnotherDatabaseIsNoJournal) {
  Database(path, Database::Open::created).run("CREATE TABLE entry (number)");
  expect_refused("is no journal of Genio");
}

TEST_F(JournalFiles, NoOtherUserMayReadOrLockThem) {
  const mode_t mask = umask(0);
  Journal journal(path);
  journal.accept(entry_of(1));
  journal.sync();
  umask(mask);
  for (const char* ending : {"", "-wal", "-shm", ".lock"}) {
    struct stat status {};
    ASSERT_EQ(stat((path + ending).c_str(), &status), 0) << ending;
    EXPECT_EQ(status.st_mode & 0777, 0600u) << ending;
  }
}

TEST_F(JournalFiles, AFolderAndAPipeAreNoJournals) {
  fs::create_directory(path);
  expect_refused("is a folder");
  fs::remove(path);
  mkfifo(path.c_str(), 0600);
  expect_refused("is a pipe");
}

TEST_F(JournalFiles, AnEmptyFileIsNotTakenForANewJournal) {
  make();
  fs::resize_file(path, 0);
  expect_refused("is empty");
}

TEST_F(JournalFiles, ALaterVersionIsRefused) {
  make();
  change("PRAGMA user_version = 2");
  expect_refused("later version");
}

TEST_F(JournalFiles, OtherTablesAreRefused) {
  make();
  change("CREATE TABLE guest (number)");
  EXPECT_NE(refusals().front().find("is damaged"), std::string::npos);
}

TEST_F(JournalFiles, AMissingJournalIsMadeForTheServerAlone) {
  const auto told = refusals();
  EXPECT_EQ(told[0], "");
  fs::remove(path);
  EXPECT_EQ(refusals()[1], "");  // the server made it again
  fs::remove(path);
  EXPECT_THROW(JournalView view(path), InputError);
  EXPECT_THROW(prune_journal(path, {}), InputError);
  EXPECT_FALSE(fs::exists(path));
}

TEST_F(JournalFiles, AFolderThatIsMissingIsTold) {
  EXPECT_THROW(Journal(folder.path() + "/nowhere/requests.journal"), InputError);
  EXPECT_THROW(Journal(""), InputError);
  EXPECT_THROW(Journal(std::string("a\0b", 3)), InputError);
}

TEST_F(JournalFiles, ALogWithoutItsJournalIsNotForgotten) {
  write_text(path + "-wal", "what was accepted");
  try {
    const Journal journal(path);
    FAIL() << "it was taken for a new one";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("remove " + path + "-wal"), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST_F(JournalFiles, ANewOneThatWasHalfMadeIsMadeAfresh) {
  write_text(path + ".new", "half");
  make();
  EXPECT_TRUE(Journal(path).find("request-1"));
  EXPECT_FALSE(fs::exists(path + ".new"));
}

TEST_F(JournalFiles, NamesWithSignsOfAUriAreNames) {
  const std::string odd = folder.path() + "/file:a?mode=memory#%41.journal";
  Journal(odd).sync();
  EXPECT_TRUE(fs::exists(odd));
  EXPECT_EQ(JournalView(odd).counts().accepted, 0);
}

TEST_F(JournalFiles, OneServerAtATimeOwnsIt) {
  make();
  const std::string link = folder.path() + "/link";
  fs::create_symlink(path, link);
  {
    const Journal owner(path);
    for (const std::string& name : {path, link}) try {
        const Journal second(name);
        FAIL() << name << " has two owners";
      } catch (const InputError& e) {
        EXPECT_EQ(std::string(e.what()), name + ": is in use by another server");
      }
    EXPECT_THROW(Journal second(path), InputError);  // nor did the attempt free it
  }
  EXPECT_NO_THROW(Journal next(path));
}

TEST_F(JournalFiles, ItsLockIsOneEmptyFile) {
  const auto names = [&] {
    std::set<std::string> found;
    for (const auto& file : fs::directory_iterator(folder.path()))
      found.insert(file.path().filename());
    return found;
  };
  const std::string name = "requests.journal";
  {
    const Journal journal(path);
    EXPECT_EQ(names(), (std::set{name, name + "-shm", name + "-wal", name + ".lock"}));
    EXPECT_EQ(fs::file_size(path + ".lock"), 0u);
  }
  EXPECT_EQ(names(), (std::set{name, name + ".lock"}));
}

TEST_F(JournalFiles, ItIsFreeOnceItsServerDiedThoughAWorkerLivesOn) {
  int life[2], worker_life[2];
  ASSERT_EQ(pipe(life) + pipe(worker_life), 0);
  const pid_t server = fork();
  if (server == 0) {
    Journal journal(path);
    journal.accept(entry_of(1));
    journal.sync();
    if (fork() == 0) {  // a worker, which ends when the test closes its pipe
      close(worker_life[1]), close(life[0]), close(life[1]);
      char byte = 0;
      [[maybe_unused]] const auto n = read(worker_life[0], &byte, 1);
      _exit(0);
    }
    [[maybe_unused]] const auto n = write(life[1], "r", 1);
    pause();
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(read(life[0], &byte, 1), 1);
  EXPECT_THROW(Journal second(path), InputError);
  kill(server, SIGKILL);
  waitpid(server, nullptr, 0);
  EXPECT_EQ(Journal(path).unanswered().size(), 1u);
  for (const int fd : {life[0], life[1], worker_life[0], worker_life[1]}) close(fd);
}

/// Runs `body` as somebody who may not write what root made; true where it returned true.
bool as_nobody(const std::function<bool()>& body) {
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && setuid(65534) != 0) _exit(1);
    _exit(body() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_F(JournalFiles, OneThatMayNotBeWrittenCanBeReadAndNoMore) {
  make();
  fs::remove(path + ".lock");
  chmod(path.c_str(), 0444);
  chmod(folder.path().c_str(), 0555);
  const auto told = [](const std::function<void()>& open) {
    try {
      open();
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const auto has = [](const std::string& text, const std::string& word) {
    if (text.find(word) != std::string::npos) return true;
    fprintf(stderr, "'%s', expected %s\n", text.c_str(), word.c_str());
    return false;
  };
  EXPECT_TRUE(as_nobody([&] {
    const std::string denied = "stands in a folder that cannot be written: Permission denied";
    return JournalView(path).counts().accepted == 1 &&
           has(told([&] { prune_journal(path, {}); }), denied) &&
           has(told([&] { Journal journal(path); }), denied) &&
           has(told([&] { Journal journal(folder.path() + "/new"); }), denied);
  }));
  chmod(folder.path().c_str(), 0777);
  EXPECT_TRUE(as_nobody([&] {
    return has(told([&] { Journal journal(path); }), ": cannot be written: Permission denied");
  }));
  chmod(folder.path().c_str(), 0755);
}

TEST_F(JournalFiles, AnEarlierVersionIsBroughtUpToDateWithAllItHolds) {
  make();
  const std::array<const char*, 2> steps = {
      journal_steps()[0], "ALTER TABLE entry ADD COLUMN place INTEGER NOT NULL DEFAULT 7"};
  Database db(path, Database::Open::existing);
  EXPECT_THROW(check_version(db, steps, true), StorageError);
  EXPECT_NO_THROW(check_version(db, steps, false));
  EXPECT_THROW(check_tables(db, steps), StorageError);
  bring_up_to_date(db, steps);
  EXPECT_NO_THROW(check_version(db, steps, true));
  EXPECT_NO_THROW(check_tables(db, steps));
  EXPECT_EQ(db.number("SELECT place FROM entry WHERE id = CAST('request-1' AS BLOB)"), 7);
}

TEST_F(JournalFiles, AStepThatFailsLeavesTheVersionBefore) {
  make();
  const std::array<const char*, 3> steps = {journal_steps()[0], "CREATE TABLE further (a)",
                                            "CREATE TABLE further (b)"};
  Database db(path, Database::Open::existing);
  EXPECT_THROW(bring_up_to_date(db, steps), StorageError);
  EXPECT_NO_THROW(check_version(db, journal_steps(), true));
  EXPECT_NO_THROW(check_tables(db, journal_steps()));
}

}  // namespace
}  // namespace genio
