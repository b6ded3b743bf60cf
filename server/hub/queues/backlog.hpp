#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "server/hub/queues/fair_queue.hpp"
#include "server/hub/queues/message.hpp"

namespace genio {

/// What waits until one connection reads: in the order in which it came, or in fair shares of its
/// senders. Its entries count in `held` beside the messages.
class HubBacklog {
 public:
  explicit HubBacklog(size_t& held) : held_(held) {}
  ~HubBacklog() { clear(); }
  HubBacklog(const HubBacklog&) = delete;
  HubBacklog& operator=(const HubBacklog&) = delete;

  /// Throws std::bad_alloc, and nothing has changed then.
  void push(std::shared_ptr<const HubMessage> message, uint64_t sender = 0, bool newcomer = false);
  /// From now on senders have fair shares; what waits goes before. There is no way back.
  void share_fairly() { fair_ = true; }
  void clear();
  bool empty() const { return queue_.empty() && shared_.empty(); }
  size_t messages() const { return queue_.size() + shared_.messages(); }
  /// What waits of one sender for its share.
  HubFairQueue::Share share(uint64_t sender) const { return shared_.share(sender); }
  HubFairQueue::Share newcomers() const { return shared_.newcomers(); }
  /// Forgets all of the sender with the largest share; nothing where there is none.
  std::optional<uint64_t> forget_heaviest();
  /// What is still to be sent, and a little for each message [bytes].
  size_t bytes() const { return bytes_; }

  struct Sent {
    size_t bytes = 0, messages = 0;  ///< messages: those whose last byte was sent
    bool broken = false;             ///< the other side is gone
  };
  /// Sends what the socket takes at once, at most `most` bytes.
  Sent send_to(int socket, size_t most);

 private:
  void take_from_shares();
  size_t drop_sent(size_t count);

  std::deque<std::shared_ptr<const HubMessage>> queue_;
  HubFairQueue shared_;
  bool fair_ = false;
  size_t sent_of_front_ = 0, bytes_ = 0;
  size_t& held_;
};

}  // namespace genio
