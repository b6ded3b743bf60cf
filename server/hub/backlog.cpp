#include "server/hub/backlog.hpp"

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace genio {
namespace {

// What the allocator and the queue take beside the bytes, so that tiny messages count as well.
constexpr size_t message_overhead = 128, entry_overhead = 32;
constexpr size_t max_pieces = 64;  // messages of one call of sendmsg

}  // namespace

HubMessage::HubMessage(std::vector<char> bytes, size_t& held)
    : bytes_(std::move(bytes)), held_(held) {
  held_ += cost();
}

HubMessage::~HubMessage() { held_ -= cost(); }

size_t HubMessage::cost() const { return bytes_.capacity() + message_overhead; }

void HubBacklog::push(std::shared_ptr<const HubMessage> message) {
  const size_t size = message->bytes().size();
  queue_.push_back(std::move(message));
  bytes_ += size + entry_overhead;
  held_ += entry_overhead;
}

void HubBacklog::clear() {
  held_ -= queue_.size() * entry_overhead;
  queue_.clear();
  sent_of_front_ = bytes_ = 0;
}

HubBacklog::Sent HubBacklog::send_to(int socket, size_t most) {
  std::array<iovec, max_pieces> pieces;
  size_t count = 0, total = 0, skipped = sent_of_front_;
  for (const auto& message : queue_) {
    if (count == max_pieces || total >= most) break;
    const std::vector<char>& bytes = message->bytes();
    const size_t size = std::min(bytes.size() - skipped, most - total);
    // The type has no constant pointer; nothing is written.
    pieces[count++] = {const_cast<char*>(bytes.data()) + skipped, size};
    total += size;
    skipped = 0;
  }
  msghdr header{};
  header.msg_iov = pieces.data();
  header.msg_iovlen = count;
  ssize_t sent = 0;
  do sent = sendmsg(socket, &header, MSG_NOSIGNAL | MSG_DONTWAIT);
  while (sent < 0 && errno == EINTR);
  if (sent < 0) return {0, 0, errno != EAGAIN && errno != EWOULDBLOCK && errno != ENOBUFS};
  return {size_t(sent), drop_sent(size_t(sent)), false};
}

/// Forgets `count` bytes that were sent; the number of messages that ended with them.
size_t HubBacklog::drop_sent(size_t count) {
  size_t ended = 0;
  bytes_ -= count;
  sent_of_front_ += count;
  while (!queue_.empty() && sent_of_front_ >= queue_.front()->bytes().size()) {
    sent_of_front_ -= queue_.front()->bytes().size();
    queue_.pop_front();
    bytes_ -= entry_overhead;
    held_ -= entry_overhead;
    ++ended;
  }
  return ended;
}

}  // namespace genio
