#pragma once
// What the server accepted and what it answered, on disk: nothing of it is lost, however the server
// ends.

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/journal/entry.hpp"
#include "server/journal/limits.hpp"

namespace genio {

/// The journal cannot be written or read for now: the disk is full, for example. The message is one
/// line that names the file. The journal may be used on; see Journal.
class JournalError : public std::runtime_error {
 public:
  JournalError(const std::string& what, std::vector<std::string> refused, bool busy = false)
      : std::runtime_error(what), refused_(std::move(refused)), busy_(busy) {}
  /// Ids that were accepted since the last sync() and are forgotten: they must be refused.
  const std::vector<std::string>& refused() const { return refused_; }
  /// Another program wrote for too long; each further change would wait as long.
  bool busy() const { return busy_; }

 private:
  std::vector<std::string> refused_;
  bool busy_ = false;
};

enum class Acceptance {
  fresh,  ///< to be computed
  again,  ///< the same id and content was accepted before: find() tells what became of it
  other,  ///< the id was used for another content
  full,   ///< what is not answered fills the journal (JournalLimits::max_bytes)
};

/// Requests with their states, for the one process that owns the file; genio journal may read and
/// prune it meanwhile. Changes are seen by this object at once, and stand on disk once sync()
/// returned: only then may a client hear of them.
///
/// Every function but the constructor throws JournalError where SQLite fails, and where another
/// program writes for longer than five seconds. Then what was accepted since the last sync() is
/// forgotten, with what the call itself was to accept or to count. Replies, deliveries and earlier
/// tries are kept in memory and written with the next change or sync(): a full disk costs no
/// answer. Where find() or unanswered() meet a damaged entry, nothing is forgotten.
///
/// One thread at a time may use it. A process that is forked off must neither use nor destroy it.
class Journal {
 public:
  /// Makes the file where there is none; ":memory:" keeps all in memory. Throws InputError that
  /// names the file where it is no journal, is damaged, was written by a later version, may not be
  /// written, or is owned by another server. Reads the whole file once: some 1.5 s a GB.
  explicit Journal(const std::string& path, const JournalLimits& limits = {});
  /// What was not synced is lost, as nobody was told of it.
  ~Journal();
  Journal(Journal&&) noexcept;
  Journal& operator=(Journal&&) noexcept;

  /// Waits here for other programs that write, so that nothing before sync() has to.
  void begin();
  /// Of replies and other changes that wait in memory, as they could not be written [bytes].
  size_t unwritten_bytes() const;

  /// Adds a request, of which the first block of members counts, unless the id is known.
  Acceptance accept(const JournalEntry& entry);
  /// Counts a try that ended without an answer, and gives their number. 0 where no such request
  /// waits for an answer.
  int tried(const std::string& id);
  /// Keeps the reply; `status` as in the reply, time [us since 1970]. False where no such request
  /// waits for an answer: a second reply does not replace the first.
  bool answered(const std::string& id, std::vector<uint8_t> reply, const std::string& status,
                int64_t at_us);
  /// Marks that a client acknowledged the reply. False where no such reply waits for it, or where
  /// another `client` asked (empty: whoever did).
  bool delivered(const std::string& id, int64_t at_us, const std::string& client = {});
  /// Writes all changes since the last call as one transaction, which costs one flush of the disk,
  /// or nothing without changes.
  void sync();

  /// Nothing where the id is unknown, or was pruned. Throws JournalError where the entry is
  /// damaged.
  std::optional<JournalEntry> find(const std::string& id, Blobs blobs = Blobs::without) const;
  /// What is left to do after a restart: what is not answered, as it was accepted.
  std::vector<JournalEntry> unanswered(Blobs blobs = Blobs::with) const;
  JournalCounts counts() const;

  /// Takes away what the limits say, some dozen entries a call, so that no message waits long. Call
  /// it every second or so: it costs little where nothing is to be done. Does sync().
  Pruned prune(int64_t now_us);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace genio
