#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>

#include "server/hub/queues/message.hpp"

namespace genio {

/// What waits for one receiver, taken so that its senders have equal shares of it, whatever they
/// send. A message of a sender of whom nothing waits is taken after a message or two of each of the
/// others. Those of one sender stay in their order.
///
/// It is weighted fair queueing with equal weights (Demers, Keshav and Shenker 1989), by the starts
/// of messages. A message costs its bytes and a constant, as a receiver has work with each. All
/// newcomers together have the share of one, so that nobody gains by coming anew.
class HubFairQueue {
 public:
  using Message = std::shared_ptr<const HubMessage>;
  /// What waits of one sender.
  struct Share {
    size_t messages = 0, bytes = 0;
  };

  /// Throws std::bad_alloc, and nothing has changed then.
  void push(uint64_t sender, Message message, bool newcomer = false);
  /// The next one; there must be one.
  Message pop();
  void clear();

  bool empty() const { return waiting_.empty(); }
  size_t messages() const { return waiting_.size(); }
  /// That are remembered; some more than those of whom something waits.
  size_t senders() const { return senders_.size(); }
  Share share(uint64_t sender) const;
  /// What waits of those who were newcomers when they sent it.
  Share newcomers() const { return newcomers_; }

  struct Forgotten {
    uint64_t sender = 0;
    Share share = {};
  };
  /// Forgets all of the sender whose messages take most memory; there must be one.
  Forgotten forget_heaviest();

 private:
  struct Sender {
    Share share;
    uint64_t next_start = 0;
  };
  struct Waiting {
    uint64_t sender;
    Message message;
    bool newcomer;
  };
  void forget_idle_senders();

  static constexpr size_t few_senders = 1024;

  std::multimap<uint64_t, Waiting> waiting_;  // by the start of each, in units of cost
  std::unordered_map<uint64_t, Sender> senders_;
  Share newcomers_;
  uint64_t newcomers_start_ = 0;
  size_t active_ = 0;  // senders of whom something waits
  size_t many_senders_ = few_senders;
  // The start of what would be taken now if all who wait had their equal shares at every moment.
  uint64_t now_ = 0;
};

}  // namespace genio
