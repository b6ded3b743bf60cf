#pragma once
// How much of what was answered is kept, and how long.

#include <cstdint>
#include <limits>

namespace genio {

struct JournalLimits {
  /// Of the file. What was answered makes room, the delivered first; what is not answered never
  /// does, but no more of it than this is accepted.
  int64_t max_bytes = int64_t(1) << 30;
  int64_t keep_delivered_us = int64_t(7) * 86'400'000'000;  ///< after the answer
  int64_t keep_answered_us =
      int64_t(30) * 86'400'000'000;  ///< the same, of what nobody acknowledged
};

/// What is taken away. What is not answered never is.
struct PruneRule {
  int64_t delivered_before_us = 0;  ///< delivered entries that were answered before this time
  int64_t answered_before_us = 0;   ///< answered entries that nobody acknowledged
  /// Where the file holds more [bytes], the oldest delivered entries go, then the oldest answered.
  int64_t keep_bytes = std::numeric_limits<int64_t>::max();
  bool delivered_only = false;  ///< in every case
};

struct Pruned {
  int64_t delivered = 0, answered = 0;  ///< entries
  int64_t bytes = 0;                    ///< of their requests and replies
  bool more = false;                    ///< something is left to do: call again
};

}  // namespace genio
