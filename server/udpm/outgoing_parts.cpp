#include "server/udpm/outgoing_parts.hpp"

#include <algorithm>

namespace genio {

size_t OutgoingParts::Kept::cost() const {
  // What waits is counted as if it were all parts, which it is at first.
  return sizeof(Kept) + message.bytes.size() + sendings.size() * (sizeof(int32_t) + 2);
}

std::list<OutgoingParts::Kept>::iterator OutgoingParts::find(const std::string& digest) {
  return std::find_if(kept_.begin(), kept_.end(),
                      [&](const Kept& kept) { return kept.digest == digest; });
}

void OutgoingParts::erase(std::list<Kept>::iterator kept) {
  kept_bytes_ -= kept->cost();
  kept_.erase(kept);
}

/// Forgets what was sent, oldest first, until a message of so many bytes finds room.
bool OutgoingParts::make_room(size_t bytes) {
  const auto fits = [&] {
    return kept_bytes_ + bytes <= limits_.kept_bytes && kept_.size() < limits_.kept_messages;
  };
  for (auto it = kept_.begin(); it != kept_.end() && !fits();) {
    const auto oldest = it++;
    if (oldest->waiting.empty()) erase(oldest);
  }
  return fits();
}

void OutgoingParts::enqueue(Kept& kept, int32_t index) {
  if (kept.waits[size_t(index)]) return;
  if (kept.waiting.empty()) waiting_.push_back(&kept);
  kept.waiting.push_back(index), kept.waits[size_t(index)] = true;
}

bool OutgoingParts::add(WholeMessage message, int64_t utime, UdpmTime now) {
  std::string digest = message_digest(message.channel, message.bytes);
  auto it = find(digest);
  if (it == kept_.end()) {
    Kept kept;
    kept.capacity = part_capacity(message.channel, limits_.datagram_bytes);
    const size_t count = (message.bytes.size() + kept.capacity - 1) / kept.capacity;
    kept.message = std::move(message), kept.digest = std::move(digest);
    kept.waits.resize(count), kept.sendings.resize(count);
    if (!make_room(kept.cost())) return false;
    kept_bytes_ += kept.cost();
    kept_.push_back(std::move(kept));
    it = std::prev(kept_.end());
  } else {
    kept_.splice(kept_.end(), kept_, it);
  }
  it->utime = utime, it->sent = now;
  std::fill(it->sendings.begin(), it->sendings.end(), uint8_t(0));
  for (size_t k = 0; k < it->waits.size(); ++k) enqueue(*it, int32_t(k));
  return true;
}

void OutgoingParts::resend(const part_ask_t& ask, UdpmTime now) {
  const auto it = find(ask.message);
  if (it == kept_.end()) return;
  ++counts_.asks_in;
  it->sent = now;
  for (const int32_t index : ask.index) {
    if (index < 0 || size_t(index) >= it->waits.size() || it->waits[size_t(index)]) continue;
    if (it->sendings[size_t(index)] >= limits_.sendings) continue;
    enqueue(*it, index);
    ++counts_.resent;
  }
}

std::list<OutgoingParts::Kept*>::const_iterator OutgoingParts::first() const {
  return std::min_element(waiting_.begin(), waiting_.end(), [](const Kept* a, const Kept* b) {
    return a->waiting.size() < b->waiting.size();
  });
}

std::optional<part_t> OutgoingParts::next() const {
  if (waiting_.empty()) return std::nullopt;
  const Kept& kept = **first();
  return cut_part(kept.message, kept.digest, kept.utime, kept.capacity,
                  size_t(kept.waiting.front()));
}

void OutgoingParts::sent(UdpmTime now) {
  const auto place = first();
  Kept& kept = **place;
  const auto index = size_t(kept.waiting.front());
  kept.waiting.pop_front();
  kept.waits[index] = false, ++kept.sendings[index];
  kept.sent = now;
  ++counts_.parts_out;
  if (kept.waiting.empty()) waiting_.erase(place);
}

void OutgoingParts::forget_old(UdpmTime now) {
  for (auto it = kept_.begin(); it != kept_.end();) {
    const auto kept = it++;
    if (kept->waiting.empty() && now - kept->sent > limits_.kept) erase(kept);
  }
}

}  // namespace genio
