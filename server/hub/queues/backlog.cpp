#include "server/hub/queues/backlog.hpp"

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>
#include <utility>

namespace genio {
namespace {

// What a queue takes beside the messages, so that tiny ones count as well.
constexpr size_t entry_overhead = 96;
constexpr size_t max_pieces = 64;  // messages of one call of sendmsg
// Of what is sent next; who comes later goes after it.
constexpr size_t settled_messages = 8, settled_bytes = 4 << 10;

}  // namespace

void HubBacklog::push(std::shared_ptr<const HubMessage> message, uint64_t sender, bool newcomer) {
  const size_t size = message->bytes().size();
  if (fair_) shared_.push(sender, std::move(message), newcomer);
  else queue_.push_back(std::move(message));
  bytes_ += size + entry_overhead;
  held_ += entry_overhead;
}

void HubBacklog::clear() {
  held_ -= messages() * entry_overhead;
  queue_.clear();
  shared_.clear();
  sent_of_front_ = bytes_ = 0;
}

std::optional<uint64_t> HubBacklog::forget_heaviest() {
  if (shared_.empty()) return std::nullopt;
  const HubFairQueue::Forgotten forgotten = shared_.forget_heaviest();
  const size_t overhead = forgotten.share.messages * entry_overhead;
  bytes_ -= forgotten.share.bytes + overhead;
  held_ -= overhead;
  return forgotten.sender;
}

void HubBacklog::take_from_shares() {
  if (shared_.empty()) return;
  size_t settled = 0;
  for (const auto& message : queue_) settled += message->bytes().size();
  while (!shared_.empty() && queue_.size() < settled_messages && settled < settled_bytes) {
    try {
      queue_.emplace_back();
    } catch (const std::bad_alloc&) {
      return;  // they wait until there is memory
    }
    queue_.back() = shared_.pop();
    settled += queue_.back()->bytes().size();
  }
}

HubBacklog::Sent HubBacklog::send_to(int socket, size_t most) {
  take_from_shares();
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
