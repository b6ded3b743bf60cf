// Any single call of the system fails: what the journal said before and says then is true.

#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "forward/base/types.hpp"
#include "server/journal/sqlite/database.hpp"
#include "tests/runs/temporary_folder.hpp"
#include "tests/server/journal/journal_entries.hpp"
#include "tests/server/journal/recorded_disk.hpp"

namespace genio {
namespace {

using test::as_made;
using test::entry_of;
using test::reply_of;

constexpr size_t small_request = 700, small_reply = 5000;

std::string fault_id(unsigned k) { return entry_of(k, 0).id; }

/// A server over a journal, with what it was told of each request.
class ToldServer {
 public:
  explicit ToldServer(Journal& journal) : journal_(journal) {}

  struct Request {
    int tries = 0;
    JournalState state = JournalState::accepted;
  };
  std::map<unsigned, Request> told;
  std::set<unsigned> refused;
  int failures = 0;

  void turn(unsigned k) {
    for (const unsigned fresh : {2 * k, 2 * k + 1})
      attempt([&] {
        refused.insert(fresh);
        if (journal_.accept(entry_of(fresh, small_request)) != Acceptance::fresh) return;
        refused.erase(fresh), told[fresh], unsynced_.insert(fresh);
      });
    attempt([&] { check(journal_, 2 * k); });
    if (k % 4 != 3) attempt([&] { journal_.sync(), unsynced_.clear(); });
    for (const unsigned known : {2 * k, k})
      attempt([&] {
        if (const int tries = journal_.tried(fault_id(known))) told[known].tries = tries;
      });
    attempt([&] { check(journal_, k); });
    becomes(k, JournalState::answered,
            [&] { journal_.answered(fault_id(k), reply_of(k, small_reply), "converged", k + 1); });
    if (k % 3 == 0)
      becomes(k, JournalState::delivered, [&] { journal_.delivered(fault_id(k), k + 2); });
    attempt([&] { journal_.sync(), unsynced_.clear(); });
  }

  /// What was answered or delivered stays so although that was told with an exception.
  void becomes(unsigned k, JournalState state, const std::function<void()>& change) {
    const bool known = told.contains(k) && !unsynced_.contains(k);
    const bool fails = attempt(change);
    if (told.contains(k) && (known || !fails)) told[k].state = state;
  }

  /// That a journal says of a request what was told.
  void check(const Journal& journal, unsigned k) const {
    const auto entry = journal.find(fault_id(k), Blobs::with);
    EXPECT_EQ(entry.has_value(), told.contains(k)) << k;
    if (!entry || !told.contains(k)) return;
    EXPECT_TRUE(as_made(*entry, k, small_request, small_reply)) << k;
    EXPECT_EQ(entry->tries, told.at(k).tries) << k;
    EXPECT_EQ(entry->state, told.at(k).state) << k;
  }

 private:
  /// True where it fails; then what was not synced is refused, all or none of it.
  bool attempt(const std::function<void()>& work) {
    try {
      work();
      return false;
    } catch (const JournalError& e) {
      ++failures;
      std::set<std::string> ids, expected;
      for (const std::string& id : e.refused()) ids.insert(id);
      for (const unsigned k : unsynced_) expected.insert(fault_id(k));
      EXPECT_EQ(ids, expected);
      for (const unsigned k : unsynced_) refused.insert(k), told.erase(k);
      unsynced_.clear();
      return true;
    }
  }

  Journal& journal_;
  std::set<unsigned> unsynced_;
};

struct Fault {
  std::string name;
  test::RecordedDisk::Call call;
  int code;
  int times;
};

/// After another program wrote, SQLite reads again what it had in memory.
void write_beside(const std::string& path, test::RecordedDisk& disk) {
  const auto fault = std::exchange(disk.fault, {});
  Database(path, Database::Open::existing).run("PRAGMA user_version = 1");
  disk.fault = fault;
}

class Faults : public testing::TestWithParam<Fault> {};

TEST_P(Faults, AtAnyMomentCostWhatIsToldAndNothingElse) {
  const Fault& fault = GetParam();
  int calls = 1, failures = 0;
  for (int at = 0; at < calls; ++at) {
    const test::TemporaryFolder folder(test::memory_folder());
    const std::string path = folder.path() + "/journal";
    test::RecordedDisk disk;
    calls = 0;
    disk.fault = [&](test::RecordedDisk::Call call) {
      if (call != fault.call) return SQLITE_OK;
      const int now = calls++;
      return now >= at && now < at + fault.times ? fault.code : SQLITE_OK;
    };
    std::optional<Journal> journal;
    try {
      journal.emplace(path);
    } catch (const InputError&) {
      ++failures, calls = std::max(calls, at + 2);
      disk.fault = {};
      EXPECT_NO_THROW(Journal again(path));
      continue;
    }
    ToldServer server(*journal);
    for (unsigned k = 0; k < 8; ++k) {
      write_beside(path, disk);
      server.turn(k);
    }
    disk.fault = {};
    for (const auto& [k, request] : server.told) server.check(*journal, k);
    EXPECT_NO_THROW(journal->sync());
    failures += server.failures;
    journal.reset();
    journal.emplace(path);
    for (const auto& [k, request] : server.told) server.check(*journal, k);
    for (const unsigned k : server.refused) server.check(*journal, k);
    if (HasFailure()) FAIL() << "call " << at << " failed";
  }
  EXPECT_GT(failures, 0);
  RecordProperty("calls", calls);
  RecordProperty("failures", failures);
}

using Call = test::RecordedDisk::Call;
INSTANTIATE_TEST_SUITE_P(OfTheDisk, Faults,
                         testing::Values(Fault{"Read", Call::read, SQLITE_IOERR_READ, 1},
                                         Fault{"Reads", Call::read, SQLITE_IOERR_READ, 5},
                                         Fault{"Write", Call::write, SQLITE_IOERR_WRITE, 1},
                                         Fault{"Room", Call::write, SQLITE_FULL, 4},
                                         Fault{"Flush", Call::flush, SQLITE_IOERR_FSYNC, 1},
                                         Fault{"Flushes", Call::flush, SQLITE_IOERR_FSYNC, 3}),
                         [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace genio
