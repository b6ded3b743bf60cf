#pragma once
#include <cstddef>
#include <cstdint>

namespace genio {

/// What is asked of sealed messages beside a right seal.
struct SealLimits {
  int64_t window_us = 30'000'000;  ///< between the time of a seal and that of the receiver
  /// Messages taken that are remembered, on each channel. A memory that is full forgets the oldest,
  /// and nothing that was sealed as early is taken any more.
  size_t remembered = 1 << 16;
  /// Nothing is taken that was sealed longer before the receiver began. Clocks of two hosts may
  /// differ by as much without a loss.
  int64_t before_start_us = 1'000'000;
  int answers = 20;          ///< to senders without a key at once: more get none
  double answers_per_s = 5;  ///< likewise, after those
};

}  // namespace genio
