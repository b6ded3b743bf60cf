#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/journal/entry.hpp"

namespace genio {

/// A journal as others than its server see it, also while that runs: what was synced.
class JournalView {
 public:
  /// Throws InputError naming the file where it is missing, is no journal, or is of another
  /// version.
  explicit JournalView(const std::string& path);
  ~JournalView();

  /// Throws InputError where the file is damaged.
  JournalCounts counts() const;

  /// Nothing where the id is unknown. Throws InputError where the entry is damaged.
  std::optional<JournalEntry> find(const std::string& id) const;

  /// `damage` is empty, or says what is wrong with an entry that differs from its checksums.
  using Visit = std::function<void(const JournalEntry& entry, const std::string& damage)>;
  /// Visits every entry as it was accepted. Between two visits the server may go on, and entries
  /// may be pruned. Throws InputError where the structure of the file is damaged.
  void each(Blobs blobs, const Visit& visit) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace genio
