#include "server/journal/retention.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace genio {
namespace {

constexpr int64_t any_time = std::numeric_limits<int64_t>::max();

struct Choice {
  JournalState state;
  std::vector<JournalTable::Candidate> entries;
};

/// Answered entries only where no more delivered ones are left to choose.
std::vector<Choice> choose_by_age(JournalTable& table, const PruneRule& rule, int most) {
  std::vector<Choice> chosen;
  chosen.push_back({JournalState::delivered,
                    table.oldest(JournalState::delivered, rule.delivered_before_us, most)});
  const int left = most - int(chosen.front().entries.size());
  if (!rule.delivered_only && left > 0)
    chosen.push_back({JournalState::answered,
                      table.oldest(JournalState::answered, rule.answered_before_us, left)});
  return chosen;
}

/// As many as hold `excess` bytes.
std::vector<Choice> choose_by_size(JournalTable& table, const PruneRule& rule, int64_t excess,
                                   int most) {
  std::vector<Choice> chosen;
  for (const JournalState state : {JournalState::delivered, JournalState::answered}) {
    if (excess <= 0 || most <= 0) break;
    if (state == JournalState::answered && rule.delivered_only) break;
    Choice choice{state, table.oldest(state, any_time, most)};
    size_t taken = 0;
    for (; taken < choice.entries.size() && excess > 0; ++taken)
      excess -= choice.entries[taken].bytes;
    choice.entries.resize(taken);
    most -= int(taken);
    chosen.push_back(std::move(choice));
  }
  return chosen;
}

bool is_empty(const std::vector<Choice>& chosen) {
  return std::all_of(chosen.begin(), chosen.end(),
                     [](const Choice& choice) { return choice.entries.empty(); });
}

std::vector<Choice> choose(const Database& db, JournalTable& table, const PruneRule& rule,
                           int most) {
  auto chosen = choose_by_age(table, rule, most);
  if (is_empty(chosen)) {
    const int64_t used = used_bytes(db);
    if (used > rule.keep_bytes) chosen = choose_by_size(table, rule, used - rule.keep_bytes, most);
  }
  return chosen;
}

}  // namespace

JournalCounts counts_of(const Database& db, JournalTable& table) {
  const int64_t free = free_bytes(db);
  return {table.count(JournalState::accepted), table.count(JournalState::answered),
          table.count(JournalState::delivered), used_bytes(db) + free, free};
}

int64_t used_bytes(const Database& db) {
  return db.number("PRAGMA page_count") * db.number("PRAGMA page_size") - free_bytes(db);
}

int64_t free_bytes(const Database& db) {
  return db.number("PRAGMA freelist_count") * db.number("PRAGMA page_size");
}

bool has_prunable(const Database& db, JournalTable& table, const PruneRule& rule) {
  return !is_empty(choose(db, table, rule, 1));
}

Pruned prune_some(Database& db, JournalTable& table, const PruneRule& rule, int most) {
  Pruned pruned;
  for (const Choice& choice : choose(db, table, rule, most))
    for (const auto& [number, bytes] : choice.entries) {
      // Whoever calls until nothing is left would do so for ever.
      if (!table.remove(number))
        throw StorageError(StorageError::Kind::damaged, "is damaged: its index is not its table's");
      ++(choice.state == JournalState::delivered ? pruned.delivered : pruned.answered);
      pruned.bytes += bytes;
    }
  pruned.more = has_prunable(db, table, rule);
  return pruned;
}

void give_back(Database& db, int64_t most) {
  const int64_t pages = most / db.number("PRAGMA page_size");
  if (pages > 0) db.run(fmt::format("PRAGMA incremental_vacuum({})", pages));
}

}  // namespace genio
