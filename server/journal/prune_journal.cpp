#include "server/journal/prune_journal.hpp"

#include <utility>

#include "forward/base/types.hpp"
#include "server/journal/open_journal.hpp"
#include "server/journal/retention.hpp"

namespace genio {

Pruned prune_journal(const std::string& path, const PruneRule& rule, int most_at_once) {
  constexpr int64_t back_at_once = 1 << 20;  // [bytes]
  try {
    Database db = open_to_prune(journal_path(path));
    JournalTable table(db);
    Pruned all;
    do {
      Transaction transaction(db);
      const Pruned some = prune_some(db, table, rule, most_at_once);
      give_back(db, back_at_once);
      transaction.commit();
      all.delivered += some.delivered, all.answered += some.answered, all.bytes += some.bytes;
      all.more = some.more;
    } while (all.more);
    for (int64_t before = 0, left = free_bytes(db); left > 0 && left != before;) {
      Transaction transaction(db);
      give_back(db, back_at_once);
      transaction.commit();
      before = std::exchange(left, free_bytes(db));
    }
    // Where a server or a reader is in the way, its next checkpoint cuts the file.
    db.run("PRAGMA busy_timeout = 0; PRAGMA wal_checkpoint(TRUNCATE)");
    return all;
  } catch (const StorageError& e) {
    throw InputError(path + ": " + e.what());
  }
}

}  // namespace genio
