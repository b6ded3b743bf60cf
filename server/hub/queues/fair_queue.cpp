#include "server/hub/queues/fair_queue.hpp"

#include <algorithm>
#include <utility>

namespace genio {
namespace {

constexpr uint64_t cost_of_any = 4096;  // bytes that take as long as what every message takes

void add(HubFairQueue::Share& share, size_t bytes) { ++share.messages, share.bytes += bytes; }

void remove(HubFairQueue::Share& share, size_t bytes) { --share.messages, share.bytes -= bytes; }

/// Memory that it takes, or nearly so.
size_t weight(const HubFairQueue::Share& share) { return share.bytes + 256 * share.messages; }

}  // namespace

void HubFairQueue::push(uint64_t sender, Message message, bool newcomer) {
  if (senders_.size() >= many_senders_) forget_idle_senders();
  Sender& s = senders_[sender];
  const size_t size = message->bytes().size();
  const uint64_t start = std::max({now_, s.next_start, newcomer ? newcomers_start_ : 0});
  waiting_.emplace(start, Waiting{sender, std::move(message), newcomer});
  s.next_start = start + size + cost_of_any;
  active_ += s.share.messages == 0;
  add(s.share, size);
  if (newcomer) newcomers_start_ = s.next_start, add(newcomers_, size);
}

HubFairQueue::Message HubFairQueue::pop() {
  const auto first = waiting_.begin();
  Sender& s = senders_.at(first->second.sender);
  Message message = std::move(first->second.message);
  const size_t size = message->bytes().size();
  // So that newcomers without end do not keep the others from their turn.
  now_ = std::max(now_, first->first) + (size + cost_of_any) / active_;
  remove(s.share, size);
  if (first->second.newcomer) remove(newcomers_, size);
  active_ -= s.share.messages == 0;
  waiting_.erase(first);
  if (waiting_.empty()) clear();
  return message;
}

void HubFairQueue::clear() {
  waiting_.clear();
  senders_.clear();
  newcomers_ = {};
  active_ = now_ = newcomers_start_ = 0;
}

HubFairQueue::Share HubFairQueue::share(uint64_t sender) const {
  const auto found = senders_.find(sender);
  return found == senders_.end() ? Share{} : found->second.share;
}

HubFairQueue::Forgotten HubFairQueue::forget_heaviest() {
  const auto heaviest = std::max_element(
      senders_.begin(), senders_.end(),
      [](const auto& a, const auto& b) { return weight(a.second.share) < weight(b.second.share); });
  const Forgotten forgotten{heaviest->first, heaviest->second.share};
  std::erase_if(waiting_, [&](const auto& entry) {
    const auto& [sender, message, newcomer] = entry.second;
    if (sender != forgotten.sender) return false;
    if (newcomer) remove(newcomers_, message->bytes().size());
    return true;
  });
  senders_.erase(heaviest);
  --active_;
  if (waiting_.empty()) clear();
  return forgotten;
}

/// Those whose turn would not come later than that of a newcomer. It is done when there are twice
/// as many as were left the last time, so that it costs little.
void HubFairQueue::forget_idle_senders() {
  std::erase_if(senders_, [this](const auto& entry) {
    return entry.second.share.messages == 0 && entry.second.next_start <= now_;
  });
  many_senders_ = std::max(few_senders, 2 * senders_.size());
}

}  // namespace genio
