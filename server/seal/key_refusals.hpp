#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/dispatch/replies.hpp"
#include "server/seal/limits.hpp"

namespace genio {

/// Tells senders without a key that one is asked for. All of them together get a limited number of
/// such replies, so that nobody can make the server send much by sending little.
class KeyRefusals {
 public:
  explicit KeyRefusals(const SealLimits& limits) : limits_(limits), left_(limits.answers) {}

  /// What is to be published, without a seal, for a message that came without one at the time
  /// `now`. An older client gets the reply types that it knows. Empty where the message does not
  /// name its client, or where too many were told already.
  std::vector<OutgoingMessage> answer(const void* data, size_t size, int64_t now);

 private:
  SealLimits limits_;
  double left_;       // messages that may be answered now
  int64_t last_ = 0;  // when `left_` was that
};

}  // namespace genio
