#include "server/journal/journal_view.hpp"

#include "forward/base/types.hpp"
#include "server/journal/open_journal.hpp"
#include "server/journal/retention.hpp"

namespace genio {

struct JournalView::State {
  explicit State(const std::string& name)
      : shown(name), db(open_to_read(journal_path(name))), table(db) {}

  std::string shown;
  Database db;
  JournalTable table;

  InputError refusal(const StorageError& e) const { return InputError(shown + ": " + e.what()); }
};

JournalView::JournalView(const std::string& path) try : state_(std::make_unique<State>(path)) {
} catch (const StorageError& e) {
  throw InputError(path + ": " + e.what());
}

JournalView::~JournalView() = default;

JournalCounts JournalView::counts() const try {
  return counts_of(state_->db, state_->table);
} catch (const StorageError& e) {
  throw state_->refusal(e);
}

std::optional<JournalEntry> JournalView::find(const std::string& id) const try {
  auto entry = state_->table.find(id);
  if (entry && !state_->table.load(*entry)) return std::nullopt;
  return entry;
} catch (const StorageError& e) {
  throw state_->refusal(e);
}

void JournalView::each(Blobs blobs, const Visit& visit) const try {
  constexpr int at_once =
      500;  // entries without blobs; the file is not held while they are visited
  int64_t last = 0;
  for (;;) {
    const auto some = state_->table.after(last, at_once);
    if (some.empty()) return;
    last = some.back().entry.number;
    for (auto [entry, whole] : some) {
      std::string damage = whole ? "" : "the row differs from its checksum";
      if (blobs == Blobs::with) {
        try {
          if (!state_->table.load(entry)) continue;
        } catch (const StorageError& e) {
          if (e.kind() != StorageError::Kind::damaged) throw;
          damage = e.what();
        }
      }
      visit(entry, damage);
    }
  }
} catch (const StorageError& e) {
  throw state_->refusal(e);
}

}  // namespace genio
