#pragma once
// What waits, runs and was answered: between the thread of the messages and the one that computes.

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/dispatch/limits.hpp"
#include "server/dispatch/record.hpp"
#include "server/dispatch/replies.hpp"

namespace genio {

/// A request that is to be computed.
struct Assignment {
  shape_request_t request;
  double deadline_s = 0;  ///< that are left, from now on; 0: no deadline
};

/// What happened since it was last taken: records to be kept before the messages are published.
struct Outgoing {
  std::vector<Record> records;
  std::vector<OutgoingMessage> messages;
};

/// What a journal that keeps the records knows; none of both where there is none.
struct JournalLookup {
  std::function<std::optional<KnownRequest>(const std::string& id)> find = {};
  explicit operator bool() const { return bool(find); }
};

/// Requests in the order of their arrival, each answered once. A repeated id with the same content
/// gets the reply of the first, whoever sends it; with other content it is refused. Only the client
/// that asked first may withdraw a request. Deadlines count from the arrival, time in the queue
/// with them; at its deadline a request is answered with the best shape so far. Every request gets
/// a reply, also one that is refused. Times are of now_us(). Safe to use from several threads.
class Dispatcher {
 public:
  /// `wake` is called, from any thread, when there is something to publish.
  explicit Dispatcher(const DispatchLimits& limits, std::function<void()> wake = {},
                      JournalLookup journal = {});

  // The thread of the messages:

  /// A message on the request channel. One that cannot be read is answered to whom its beginning
  /// names, else to the client "undecodable".
  void receive_request(const void* data, size_t size, int64_t now);
  /// A message on the channel of cancellations. A waiting request is answered at once, a running
  /// one by the thread that computes. Who may not cancel, or names no such request, is told.
  void receive_cancel(const void* data, size_t size);
  /// A message on the channel of acknowledgements.
  void receive_ack(const void* data, size_t size);
  /// Takes up what an earlier process accepted and did not answer. `tries`: computations that
  /// ended with the process; after two it is answered as failed.
  void resume(const AcceptedRecord& record, int tries);
  /// Refuses what was accepted and could not be kept.
  void drop(const std::string& id, const std::string& reason);
  /// Answers what has passed its deadline.
  void pass_deadlines(int64_t now);
  /// Each record and message is given once.
  Outgoing take_outgoing();
  /// The counts of a status message.
  server_status_t counts() const;
  /// Lets the computing thread end after the request that it works on, which counts as withdrawn.
  void close();
  /// Answers those that still wait, unless a journal keeps them: nobody will work on them. Only
  /// after the computing thread ended.
  void refuse_waiting();

  // The computing thread:

  /// Waits for the next request, which runs until finish(); nothing once the dispatcher is closed.
  std::optional<Assignment> next();
  /// True where nobody wants the answer any more, or it was given at its deadline.
  bool withdrawn(const std::string& id) const;
  /// Tells the clients of a request how far it is; `rms` [m].
  void report_progress(const std::string& id, int iteration, double rms);
  /// What is to be answered if the deadline passes now.
  void keep_best(const std::string& id, command_reply_t reply);
  /// Sends the reply to all that asked, and remembers it. `seconds`: that it took.
  void finish(const std::string& id, const command_reply_t& reply, double seconds);

 private:
  enum class State { waiting, running, answered };
  struct Entry {
    shape_request_t request;
    std::string digest;
    std::vector<std::string> clients;  ///< that asked; the first may withdraw it
    size_t bytes = 0;
    int64_t deadline = 0;  ///< 0: none
    State state = State::waiting;
    bool cancelled = false;
    std::optional<command_reply_t> best;  ///< so far; or the reply
  };

  // All with the mutex held.
  void send(OutgoingMessage message);
  void keep(Record record);
  void reply_to(const std::string& client, command_reply_t reply);
  void refuse(const std::string& client, const std::string& id, const std::string& reason,
              double retry_after_s = 0);
  void accept(shape_request_t request, std::vector<uint8_t> bytes, int64_t now);
  void enqueue(shape_request_t request, const AcceptedRecord& record);
  void ask_again(const shape_request_t& request, Entry& entry);
  void answer(Entry& entry, command_reply_t reply);
  void forget_oldest();
  void take_from_queue(const std::string& id);
  double seconds_until_free() const;

  const DispatchLimits limits_;
  const std::function<void()> wake_;
  const JournalLookup journal_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;       // something waits, or it was closed
  std::map<std::string, Entry> entries_;  // by id
  std::deque<std::string> waiting_;       // ids, oldest first
  std::deque<std::string> answered_;      // ids, oldest first
  std::string running_;                   // id; empty: none
  size_t waiting_bytes_ = 0, answered_bytes_ = 0;
  double usual_seconds_ = 1;  // of a request
  Outgoing outgoing_;
  bool closed_ = false;
  int64_t received_ = 0, replied_ = 0, refused_ = 0;
};

}  // namespace genio
