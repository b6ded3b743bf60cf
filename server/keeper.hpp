#pragma once
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/dispatch/outbox.hpp"
#include "server/journalled.hpp"

namespace genio {

/// What may be published, as its records stand on the disk; and what could not be kept.
struct KeptBatch {
  std::vector<OutgoingMessage> messages;
  std::vector<Unkept> unkept;
};

/// Writes a dispatcher's records into a journal, in a thread of its own: a slow disk delays the
/// replies that wait for it, and nothing else.
class Keeper {
 public:
  /// Throws InputError where the file cannot be the journal, see Journal. `failed` is
  /// called from the thread, with the reason, where the file cannot be pruned.
  Keeper(const std::string& path, std::function<void(const std::string&)> failed);
  /// Writes what was handed over.
  ~Keeper();
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

  /// What an earlier process left. Before anything is handed over.
  std::vector<JournalEntry> unanswered() const { return journal_->unanswered(); }
  /// For the thread of the messages; see JournalLookup.
  std::optional<KnownRequest> find(const std::string& id) const {
    return known_request(*view_, id);
  }
  /// Hands over what is to be kept before it is published.
  void hand_over(Outgoing outgoing);
  /// Becomes readable when collect() has something.
  int descriptor() const { return done_signal_; }
  KeptBatch collect();
  /// Waits until all that was handed over is kept, or could not be.
  void finish();

 private:
  void work();
  void write(Outgoing outgoing);

  std::unique_ptr<Journal> journal_;
  std::unique_ptr<JournalView> view_;
  const std::function<void(const std::string&)> failed_;
  int done_signal_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Outgoing waiting_;
  KeptBatch done_;
  bool busy_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace genio
