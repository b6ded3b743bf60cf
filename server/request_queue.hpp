#pragma once
// What waits, runs and was answered: between the thread of the messages and the one that computes.

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/wire.hpp"

namespace genio {

/// A message that is to be published.
struct OutgoingMessage {
  std::string channel;
  std::vector<uint8_t> bytes;
};

struct QueueLimits {
  int waiting = 256;      ///< requests; more are refused with a reply
  int remembered = 4096;  ///< replies kept for repeated ids
};

/// Requests in the order of their arrival, each answered once: a repeated id gets the reply of the
/// first. Every request gets a reply, also one that is refused. Safe to use from several threads.
class RequestQueue {
 public:
  /// `wake` is called, from any thread, when there is something to publish.
  explicit RequestQueue(const QueueLimits& limits, std::function<void()> wake = {});

  // The thread of the messages:

  /// A message on the request channel. One that cannot be read is answered to the client
  /// "undecodable", as nobody knows who sent it.
  void receive_request(const void* data, size_t size);
  /// A message on the channel of cancellations; of requests that neither wait nor run, nothing.
  void receive_cancel(const void* data, size_t size);
  /// What is to be published; each message is given once.
  std::vector<OutgoingMessage> take_outgoing();
  /// The counts of a status message.
  server_status_t counts() const;
  /// Lets the computing thread end after the request that it works on, which counts as withdrawn.
  void close();
  /// Answers those that still wait: nobody will work on them. Only after the computing thread
  /// ended.
  void refuse_waiting();

  // The computing thread:

  /// Waits for the next request, which runs until finish(); nothing once the queue is closed.
  std::optional<shape_request_t> next();
  /// True where nobody wants the answer any more.
  bool withdrawn(const std::string& id) const;
  /// Tells the clients of a request how far it is; `rms` [m].
  void report_progress(const std::string& id, int iteration, double rms);
  /// Sends the reply to all that asked, and remembers it.
  void finish(const std::string& id, const command_reply_t& reply);

 private:
  // All with the mutex held.
  void send(const std::string& channel, std::vector<uint8_t> bytes);
  void reply_to(const std::string& client, command_reply_t reply);
  void refuse(const std::string& client, const std::string& id, const std::string& reason);
  void accept(const shape_request_t& request);

  const QueueLimits limits_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;  // something waits, or the queue was closed
  std::deque<shape_request_t> waiting_;
  bool running_ = false;
  std::map<std::string, std::vector<std::string>> clients_;  // of what waits or runs, by id
  std::set<std::string> cancelled_;                          // ids
  std::map<std::string, command_reply_t> replies_;           // by id
  std::deque<std::string> reply_order_;                      // ids, oldest first
  std::vector<OutgoingMessage> outgoing_;
  bool closed_ = false;
  int64_t received_ = 0, replied_ = 0, refused_ = 0;
};

}  // namespace genio
