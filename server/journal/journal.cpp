#include "server/journal/journal.hpp"

#include <fmt/format.h>

#include <functional>
#include <new>
#include <utility>

#include "forward/base/types.hpp"
#include "server/journal/open_journal.hpp"
#include "server/journal/retention.hpp"
#include "server/journal/sqlite/file_lock.hpp"

namespace genio {

/// A change of an entry; false where the entry is not in the state for it.
struct JournalChange {
  std::function<bool(JournalTable&)> make;
  size_t bytes = 0;  ///< that it keeps in memory
};

namespace {

constexpr int pruned_at_once = 64;         // entries
constexpr int64_t back_at_once = 1 << 20;  // [bytes]

/// Nothing is locked beside a file that is no journal.
std::string checked_path(const std::string& name) {
  std::string path = journal_path(name);
  check_is_journal(path);
  return path;
}

constexpr size_t small_change = 256;  // [bytes]

/// A change of a damaged entry would fail for ever, and all others with it.
bool never_made(const StorageError& e) { return e.kind() == StorageError::Kind::damaged; }

JournalChange change_of_tries(const std::string& id, int tries) {
  return {[=](JournalTable& table) {
            auto entry = table.find(id);
            if (!entry || entry->state != JournalState::accepted) return false;
            entry->tries = tries;
            table.update(*entry);
            return true;
          },
          small_change};
}

}  // namespace

struct Journal::State {
  State(const std::string& name, const JournalLimits& given)
      : shown(name),
        limits(given),
        path(checked_path(name)),
        lock(path),
        db(open_own_journal(path)),
        table(db) {}

  std::string shown;
  JournalLimits limits;
  std::string path;
  FileLock lock;
  Database db;
  JournalTable table;
  // Since the last sync():
  std::vector<JournalChange> changes;  // made in the open transaction, or to be made in the next
  std::vector<std::string> accepted;   // ids, in the open transaction
  std::optional<int64_t> unanswered_bytes;

  /// Whatever ends a transaction must forget what was accepted in it.
  void check_nothing_lost() const {
    if (!accepted.empty() && !db.in_transaction())
      throw StorageError(StorageError::Kind::failed, "cannot be used: a transaction was lost");
  }
  /// Within the transaction of the changes.
  void begin() {
    if (db.in_transaction()) return;
    check_nothing_lost();
    db.run("BEGIN IMMEDIATE");
    for (auto change = changes.begin(); change != changes.end(); ++change) try {
        change->make(table);
      } catch (const StorageError& e) {
        if (never_made(e)) changes.erase(change);
        throw;
      }
  }
  /// Where changes wait for a transaction, they are made before anything is read.
  void look() {
    if (!changes.empty()) begin();
  }
  [[noreturn]] void give_up(const StorageError& e) {
    db.roll_back();
    unanswered_bytes.reset();
    throw JournalError(shown + ": " + e.what(), std::exchange(accepted, {}),
                       e.kind() == StorageError::Kind::busy);
  }
  [[noreturn]] void give_up(const std::bad_alloc&) {
    give_up(StorageError(StorageError::Kind::failed, "cannot be used: no memory is left"));
  }
  template <class F>
  auto attempt(F&& work) -> decltype(work()) {
    try {
      return work();
    } catch (const StorageError& e) {
      give_up(e);
    } catch (const std::bad_alloc& e) {
      give_up(e);
    }
  }
  /// Reads. Damage that is met there is no reason to forget what was accepted.
  template <class F>
  auto read(F&& work) -> decltype(work()) {
    attempt([&] { look(); });
    return attempt([&] {
      try {
        return work();
      } catch (const StorageError& e) {
        if (e.kind() != StorageError::Kind::damaged) throw;
        throw JournalError(shown + ": " + e.what(), {});
      }
    });
  }
  /// Makes a change. Where it fails it is made in the next transaction.
  bool make(JournalChange change) {
    try {
      begin();
      if (!change.make(table)) return false;
    } catch (const StorageError& e) {
      if (!never_made(e)) changes.push_back(std::move(change));
      give_up(e);
    } catch (const std::bad_alloc& e) {
      give_up(e);
    }
    changes.push_back(std::move(change));
    return true;
  }
  void commit() {
    look();
    check_nothing_lost();
    if (!db.in_transaction()) return;
    db.run("COMMIT");
    changes.clear();
    accepted.clear();
  }
};

namespace {

/// A damaged file is found here, and not when a client asks.
void check_entries(JournalTable& table) {
  constexpr int at_once = 1000;
  int64_t last = 0;
  for (;;) {
    const auto some = table.after(last, at_once);
    if (some.empty()) break;
    for (const auto& [entry, whole] : some)
      if (!whole)
        throw StorageError(
            StorageError::Kind::damaged,
            fmt::format("is damaged: entry {} differs from its checksum", entry.number));
    last = some.back().entry.number;
  }
  for (JournalEntry& entry : table.unanswered()) table.load(entry);
}

}  // namespace

Journal::Journal(const std::string& path, const JournalLimits& limits) try
    : state_(std::make_unique<State>(path, limits)) {
  check_entries(state_->table);
} catch (const StorageError& e) {
  throw InputError(path + ": " + e.what());
}

Journal::~Journal() = default;
Journal::Journal(Journal&&) noexcept = default;
Journal& Journal::operator=(Journal&&) noexcept = default;

Acceptance Journal::accept(const JournalEntry& entry) {
  State& s = *state_;
  return s.attempt([&] {
    s.look();
    if (const auto known = s.table.find(entry.id))
      return known->digest == entry.digest ? Acceptance::again : Acceptance::other;
    if (!s.unanswered_bytes) s.unanswered_bytes = s.table.unanswered_bytes();
    const int64_t bytes = *s.unanswered_bytes + int64_t(entry.request.size());
    if (bytes > s.limits.max_bytes) return Acceptance::full;
    s.begin();
    s.table.insert(entry);
    s.accepted.push_back(entry.id);
    s.unanswered_bytes = bytes;
    return Acceptance::fresh;
  });
}

int Journal::tried(const std::string& id) {
  State& s = *state_;
  return s.attempt([&] {
    s.look();
    const auto entry = s.table.find(id);
    if (!entry || entry->state != JournalState::accepted) return 0;
    s.begin();
    JournalChange change = change_of_tries(id, entry->tries + 1);
    change.make(s.table);
    s.changes.push_back(std::move(change));
    return entry->tries + 1;
  });
}

bool Journal::answered(const std::string& id, std::vector<uint8_t> reply, const std::string& status,
                       int64_t at_us) {
  State& s = *state_;
  const auto kept = std::make_shared<const std::vector<uint8_t>>(std::move(reply));
  s.unanswered_bytes.reset();
  return s.make({[=](JournalTable& table) {
                   auto entry = table.find(id);
                   if (!entry || entry->state != JournalState::accepted) return false;
                   entry->state = JournalState::answered;
                   entry->status = status, entry->answered_us = at_us, entry->reply = *kept;
                   table.update_with_reply(*entry);
                   return true;
                 },
                 small_change + kept->size()});
}

bool Journal::delivered(const std::string& id, int64_t at_us, const std::string& client) {
  return state_->make({[=](JournalTable& table) {
                         auto entry = table.find(id);
                         if (!entry || entry->state != JournalState::answered) return false;
                         if (!client.empty() && client != entry->client) return false;
                         entry->state = JournalState::delivered, entry->delivered_us = at_us;
                         table.update(*entry);
                         return true;
                       },
                       small_change});
}

void Journal::begin() {
  state_->attempt([&] { state_->begin(); });
}

size_t Journal::unwritten_bytes() const {
  size_t bytes = 0;
  for (const JournalChange& change : state_->changes) bytes += change.bytes;
  return bytes;
}

void Journal::sync() {
  state_->attempt([&] { state_->commit(); });
}

std::optional<JournalEntry> Journal::find(const std::string& id, Blobs blobs) const {
  State& s = *state_;
  return s.read([&] {
    auto entry = s.table.find(id);
    if (entry && blobs == Blobs::with && !s.table.load(*entry)) entry.reset();
    return entry;
  });
}

std::vector<JournalEntry> Journal::unanswered(Blobs blobs) const {
  State& s = *state_;
  return s.read([&] {
    auto entries = s.table.unanswered();
    if (blobs == Blobs::with)
      for (JournalEntry& entry : entries) s.table.load(entry);
    return entries;
  });
}

JournalCounts Journal::counts() const {
  State& s = *state_;
  return s.read([&] { return counts_of(s.db, s.table); });
}

Pruned Journal::prune(int64_t now_us) {
  State& s = *state_;
  const PruneRule rule{.delivered_before_us = now_us - s.limits.keep_delivered_us,
                       .answered_before_us = now_us - s.limits.keep_answered_us,
                       .keep_bytes = s.limits.max_bytes};
  // Some room is kept for the next entries.
  const auto roomy = [&] { return free_bytes(s.db) > s.limits.max_bytes / 8; };
  return s.attempt([&]() -> Pruned {
    s.commit();
    if (!has_prunable(s.db, s.table, rule) && !roomy()) return {};
    Transaction transaction(s.db);
    Pruned pruned = prune_some(s.db, s.table, rule, pruned_at_once);
    if (roomy()) give_back(s.db, back_at_once);
    transaction.commit();
    pruned.more = pruned.more || roomy();
    return pruned;
  });
}

}  // namespace genio
