#pragma once
#include <chrono>
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
  using Time = std::chrono::steady_clock::time_point;

  /// Throws InputError where the file cannot be the journal, see Journal. `failed` is called from
  /// the thread, with the reason, where the file cannot be pruned, and when it cannot be written
  /// any more. `most_bytes`: of what waits in memory, see is_behind().
  Keeper(const std::string& path, std::function<void(const std::string&)> failed,
         size_t most_bytes = 64u << 20);
  /// Writes what was handed over, unless finish() has given that up.
  ~Keeper();
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

  /// What an earlier process left. Before anything is handed over.
  std::vector<JournalEntry> unanswered() const { return journal_->unanswered(); }
  /// For the thread of the messages; see JournalLookup.
  std::optional<KnownRequest> find(const std::string& id) const {
    return known_request(*view_, id);
  }
  /// Hands over what is to be kept before it is published. While is_behind(), messages that are
  /// asked for again are left out, and so are deliveries: what they tell of is kept longer.
  void hand_over(Outgoing outgoing);
  /// Whether more waits for the file than should be held in memory. Nothing is to be accepted then.
  bool is_behind() const;
  /// Becomes readable when collect() has something.
  int descriptor() const { return done_signal_; }
  KeptBatch collect();
  /// Waits until all that was handed over is kept, or could not be. What is not written by `until`
  /// is given up; why, as a clause, and empty where nothing is.
  std::string finish(Time until);

 private:
  void work();
  void write(Outgoing outgoing);
  void prune(Time& next);
  size_t held_bytes() const { return waiting_bytes_ + writing_bytes_ + unwritten_bytes_; }

  std::unique_ptr<Journal> journal_;
  std::unique_ptr<JournalView> view_;
  const std::function<void(const std::string&)> failed_;
  const size_t most_bytes_;
  int done_signal_;
  std::vector<Record> put_off_;            // of the thread
  std::vector<OutgoingMessage> withheld_;  // until what they tell of is written
  mutable std::mutex mutex_;               // guards what follows
  std::condition_variable changed_;
  Outgoing waiting_;
  KeptBatch done_;
  size_t waiting_bytes_ = 0, writing_bytes_ = 0;
  size_t unwritten_bytes_ = 0;  // that failed, to be tried again
  std::string failure_;         // the last one, where something is unwritten
  bool busy_ = false, stop_ = false, given_up_ = false;
  std::thread thread_;
};

}  // namespace genio
