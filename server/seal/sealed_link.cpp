#include "server/seal/sealed_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "server/seal/seal.hpp"
#include "server/seal/seen_seals.hpp"

namespace genio {

SealedLink::SealedLink(const std::string& url, SharedKey key, const SealLimits& limits)
    : link_(url), key_(std::move(key)), limits_(limits), began_(now_us()), refusals_(limits) {}

void SealedLink::subscribe(const std::string& channel, Handler handler) {
  if (!key_) {
    link_.subscribe(channel, [this, handler = std::move(handler)](const std::string& name,
                                                                  const void* data, size_t size) {
      sealed_by_others_ += looks_sealed(data, size);
      handler(name, data, size);
    });
    return;
  }
  // A memory for each subscription, as one message may meet several.
  auto seen = std::make_shared<SeenSeals>(limits_, began_);
  link_.subscribe(channel, [this, seen = std::move(seen), handler = std::move(handler)](
                               const std::string& name, const void* data, size_t size) {
    open(name, data, size, *seen, handler);
  });
}

void SealedLink::open(const std::string& channel, const void* data, size_t size, SeenSeals& seen,
                      const Handler& handler) {
  const int64_t now = now_us();
  const OpenedSeal opened = open_seal(*key_, channel, data, size, now, limits_.window_us);
  const sealed_t& message = opened.message;
  switch (opened.fault) {
    case SealFault::unsealed:
      ++dropped_.unsealed;
      if (asked_on_.contains(channel))
        for (OutgoingMessage& answer : refusals_.answer(data, size, now))
          plain_.push_back(std::move(answer));
      return;
    case SealFault::forged:
      ++dropped_.forged;
      return;
    case SealFault::stale:
      ++dropped_.stale;
      return;
    case SealFault::none:
      break;
  }
  SealNonce nonce;
  std::copy(std::begin(message.nonce), std::end(message.nonce), nonce.begin());
  if (seen.take(message.utime, nonce, now))
    handler(channel, message.body.data(), message.body.size());
  else ++dropped_.stale;
}

bool SealedLink::publish(const std::string& channel, const std::vector<uint8_t>& bytes) {
  if (!key_) return link_.publish(channel, bytes);
  return link_.publish(channel, seal(*key_, channel, bytes, now_us(), new_nonce()));
}

bool SealedLink::wait(int timeout_ms, std::span<const int> others) {
  for (const OutgoingMessage& message : plain_) link_.publish(message.channel, message.bytes);
  plain_.clear();
  return link_.wait(timeout_ms, others);
}

std::string SealedLink::doubt() const {
  if (sealed_by_others_ > 0) return "the server there seals its messages, so --key is needed";
  if (dropped_.forged > 0) return "the messages there are sealed with another key";
  if (dropped_.stale > 0)
    return fmt::format(
        "the messages there were sealed more than {} s ago or ahead; do the clocks differ?",
        limits_.window_us / 1'000'000);
  if (dropped_.unsealed > 0)
    return "the messages there have no seal, so the server runs without --key";
  return "";
}

}  // namespace genio
