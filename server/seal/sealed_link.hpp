#pragma once
// A link of those who share a key.

#include <set>
#include <string>
#include <vector>

#include "server/link/link.hpp"
#include "server/seal/key_refusals.hpp"
#include "server/seal/limits.hpp"
#include "server/seal/seal_key.hpp"

namespace genio {

class SeenSeals;

/// Messages that were not taken, by what was wrong with them: see SealFault.
struct SealDrops {
  int64_t unsealed = 0, forged = 0, stale = 0;
};

/// A Link whose messages are sealed as they leave, and taken only with a right, fresh and new seal.
/// Without a key it is a Link. Owned by one thread.
class SealedLink {
 public:
  using Handler = Link::Handler;

  /// Throws InputError when the URL cannot be used. It need not be answered yet.
  explicit SealedLink(const std::string& url, SharedKey key = {}, const SealLimits& limits = {});
  SealedLink(const SealedLink&) = delete;
  SealedLink& operator=(const SealedLink&) = delete;

  /// `handler` gets what a sealed message holds.
  void subscribe(const std::string& channel, Handler handler);
  /// False when the connection is down. Each call makes a new seal, so that the same message may be
  /// sent again.
  bool publish(const std::string& channel, const std::vector<uint8_t>& bytes);
  /// As Link.
  bool wait(int timeout_ms, std::span<const int> others = {});
  bool connected() const { return link_.connected(); }
  uint16_t local_port() const { return link_.local_port(); }
  LinkCounts counts() const { return link_.counts(); }
  std::vector<FailedHandling> take_failures() { return link_.take_failures(); }

  /// With a key: tells senders without one, on channels to which this subscribes and where they
  /// name themselves, that it is asked for; see KeyRefusals. That leaves at the next wait().
  void ask_for_key_on(std::set<std::string> channels) { asked_on_ = std::move(channels); }

  const SealDrops& dropped() const { return dropped_; }
  /// What of the messages that came hints at a key that differs or is missing, here or there, as a
  /// clause for people; empty where nothing does.
  std::string doubt() const;

 private:
  void open(const std::string& channel, const void* data, size_t size, SeenSeals& seen,
            const Handler& handler);

  Link link_;
  SharedKey key_;
  SealLimits limits_;
  int64_t began_;
  KeyRefusals refusals_;
  std::set<std::string> asked_on_;
  std::vector<OutgoingMessage> plain_;  // that leave without a seal
  SealDrops dropped_;
  int64_t sealed_by_others_ = 0;  // that came here, where there is no key
};

}  // namespace genio
