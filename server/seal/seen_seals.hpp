#pragma once
#include <cstdint>
#include <set>
#include <utility>

#include "server/seal/limits.hpp"
#include "server/seal/seal.hpp"

namespace genio {

/// The seals that were taken on one channel, so that none is taken twice. Only right and fresh ones
/// come here, so that nobody without the key can fill it. It forgets a seal when it is no longer
/// fresh, and the oldest one when there are too many; nothing sealed as early as what was forgotten
/// is taken any more. Times are [us since 1970].
class SeenSeals {
 public:
  /// Takes nothing that was sealed longer than a moment before `began`.
  SeenSeals(const SealLimits& limits, int64_t began)
      : limits_(limits), oldest_(began - limits.before_start_us) {}

  /// True, and remembered, for a fresh seal that comes for the first time.
  bool take(int64_t utime, const SealNonce& nonce, int64_t now);
  size_t size() const { return seen_.size(); }

 private:
  void forget_first();

  SealLimits limits_;
  int64_t oldest_;  // what was sealed then or before is not known any more
  std::set<std::pair<int64_t, SealNonce>> seen_;
};

}  // namespace genio
