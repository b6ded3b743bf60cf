#pragma once
#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

namespace genio {

/// Bytes as they go over the wire, held once for all connections that wait for them. It counts
/// itself in `held` while anybody holds it.
class HubMessage {
 public:
  HubMessage(std::vector<char> bytes, size_t& held);
  ~HubMessage();
  HubMessage(const HubMessage&) = delete;
  HubMessage& operator=(const HubMessage&) = delete;

  const std::vector<char>& bytes() const { return bytes_; }

 private:
  size_t cost() const;

  std::vector<char> bytes_;
  size_t& held_;
};

/// What waits until one connection reads. Its entries count in `held` beside the messages.
class HubBacklog {
 public:
  explicit HubBacklog(size_t& held) : held_(held) {}
  ~HubBacklog() { clear(); }
  HubBacklog(const HubBacklog&) = delete;
  HubBacklog& operator=(const HubBacklog&) = delete;

  /// Throws std::bad_alloc, and nothing has changed then.
  void push(std::shared_ptr<const HubMessage> message);
  void clear();
  bool empty() const { return queue_.empty(); }
  size_t messages() const { return queue_.size(); }
  /// What is still to be sent, and a little for each message [bytes].
  size_t bytes() const { return bytes_; }

  struct Sent {
    size_t bytes = 0, messages = 0;  ///< messages: those whose last byte was sent
    bool broken = false;             ///< the other side is gone
  };
  /// Sends what the socket takes at once, at most `most` bytes.
  Sent send_to(int socket, size_t most);

 private:
  size_t drop_sent(size_t count);

  std::deque<std::shared_ptr<const HubMessage>> queue_;
  size_t sent_of_front_ = 0, bytes_ = 0;
  size_t& held_;
};

}  // namespace genio
