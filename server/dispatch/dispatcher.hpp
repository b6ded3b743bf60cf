#pragma once
// What waits, runs and was answered, without any transport, worker or clock.

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/dispatch/entry.hpp"
#include "server/dispatch/limits.hpp"
#include "server/dispatch/outbox.hpp"
#include "server/dispatch/remembered.hpp"
#include "server/dispatch/stream_states.hpp"
#include "server/dispatch/tally.hpp"
#include "server/dispatch/waiting_line.hpp"

namespace genio {

/// A request that is to be computed.
struct Assignment {
  std::string id;
  size_t model = 0;              ///< index
  std::vector<uint8_t> request;  ///< a shape_request_t, encoded
  double deadline_s = 0;         ///< that it may compute
  std::vector<uint8_t> start;    ///< where the last frame of its stream ended; empty: unknown
};

/// What a journal that keeps the records knows; none of both where there is none.
struct JournalLookup {
  std::function<std::optional<KnownRequest>(const std::string& id)> find = {};
  explicit operator bool() const { return bool(find); }
};

/// Requests, each answered once, in the order of WaitingLine. A repeated id with the same content
/// gets the reply of the first, whoever sends it; with other content it is refused. Only the client
/// that asked first may withdraw a request. Deadlines count from the arrival, time in the queue
/// with them; at its deadline a request is answered with the best shape so far. Every request gets
/// a reply, also one that is refused. Times are of process_us(). For one thread.
class Dispatcher {
 public:
  /// The first of `models` answers requests that name none.
  Dispatcher(const DispatchLimits& limits, std::vector<ModelIdentity> models,
             JournalLookup journal = {});

  /// A message on the request channel. One that cannot be read is answered to whom its beginning
  /// names, else to the client "undecodable".
  void receive_request(const void* data, size_t size, int64_t now);
  /// A message on the channel of cancellations. A waiting request is answered at once, a running
  /// one when its worker ends. Who may not cancel, or names no such request, is told.
  void receive_cancel(const void* data, size_t size, int64_t now);
  /// A message on the channel of acknowledgements.
  void receive_ack(const void* data, size_t size);
  /// Takes up what an earlier process accepted and did not answer. `tries`: computations that took
  /// a worker with them; after two it is answered as failed.
  void resume(const AcceptedRecord& record, int tries, int64_t now);
  /// Refuses what was accepted and could not be kept.
  void drop(const std::string& id, const std::string& reason);
  /// While `held` no request is taken: more waits for the journal than can be kept in memory.
  void hold(bool held) { held_ = held; }
  /// Answers what has passed its deadline.
  void pass_deadlines(int64_t now);
  /// When the next deadline passes; 0: never.
  int64_t next_deadline() const;

  /// The next request, which runs from now until finish() or lost(); nothing where none may run.
  std::optional<Assignment> next(int64_t now);
  /// Running ones that nobody waits for any more, each given once.
  std::vector<std::string> take_unwanted();
  /// Tells the clients of a request how far it is; `rms_mm` [mm].
  void report_progress(const std::string& id, int iteration, double rms_mm);
  /// What is to be answered if the deadline passes now.
  void keep_best(const std::string& id, command_reply_t reply);
  /// Sends the reply to all that asked, and remembers it. `state`: for the stream's next frame;
  /// empty: no better one than before.
  void finish(const std::string& id, command_reply_t reply, std::vector<uint8_t> state,
              int64_t now);
  /// The worker ended without an answer: once more, and after two tries it has failed.
  void lost(const std::string& id, const std::string& reason, int64_t now);
  size_t running() const { return running_.size(); }

  /// Nothing is taken or begun any more; what runs is unwanted unless a journal keeps it.
  void close();
  /// Refuses all that is not answered, unless a journal keeps it: nobody will work on it. Their
  /// number.
  size_t refuse_rest();

  /// Each record and message is given once.
  Outgoing take_outgoing() { return outbox_.take(); }
  /// Likewise each reply that was not sent before, and each message that was dropped.
  std::vector<ReplyNote> take_notes() { return outbox_.take_notes(); }
  std::vector<DropNote> take_drops() { return outbox_.take_drops(); }
  /// Puts the counts into a status.
  void tell(server_status_t& status) const;

 private:
  using Entry = RequestEntry;
  using State = RequestEntry::State;
  struct Running {
    std::string stream;
    bool unwanted = false;
  };

  void refuse(const std::string& client, const std::string& id, const std::string& reason,
              double retry_after_s = 0);
  void drop_unreadable(const char* channel, size_t size, const std::string& reason);
  void accept(shape_request_t request, std::vector<uint8_t> bytes, int64_t now);
  Entry& enqueue(shape_request_t request, const AcceptedRecord& record);
  void wait_in_line(Entry& entry);
  void ask_again(const shape_request_t& request, const std::string& digest, Entry& entry);
  /// The reply that the journal has of the id; true where nothing is left to do.
  bool answered_before(const shape_request_t& request, const std::string& digest);
  bool has_place(const std::string& client, size_t bytes) const;
  /// Empty where the request may wait.
  std::string why_full(const std::string& client, size_t bytes) const;
  void answer(Entry& entry, command_reply_t reply, int64_t now);
  void forget(const std::string& id);
  void give_up(const std::string& id);
  std::optional<Running> end_of(const std::string& id);
  std::optional<size_t> model_named(const std::string& name) const;
  double seconds_until_free() const;

  const DispatchLimits limits_;
  const std::vector<ModelIdentity> models_;
  const JournalLookup journal_;
  Outbox outbox_;
  Tally tally_;
  WaitingLine line_;
  StreamStates states_;
  std::map<std::string, Entry> entries_;                 // by id
  std::map<std::string, Running> running_;               // by id
  std::set<std::string> busy_;                           // streams of which one runs
  std::set<std::pair<int64_t, std::string>> deadlines_;  // of what is not answered
  std::vector<std::string> unwanted_;                    // running ids
  RememberedIds remembered_;
  double usual_seconds_ = 1;  // of a request
  size_t at_once_ = 1;        // requests that ran together so far
  bool closed_ = false, held_ = false;
};

}  // namespace genio
