#include "server/seal/seen_seals.hpp"

#include <algorithm>

namespace genio {

void SeenSeals::forget_first() {
  oldest_ = std::max(oldest_, seen_.begin()->first);
  seen_.erase(seen_.begin());
}

bool SeenSeals::take(int64_t utime, const SealNonce& nonce, int64_t now) {
  // A clock that was set back by more than the window would shut everybody out until it has come
  // as far again.
  if (oldest_ > now + limits_.window_us) oldest_ = now - limits_.window_us;
  while (!seen_.empty() && seen_.begin()->first < now - limits_.window_us) forget_first();
  if (utime <= oldest_ || !seen_.emplace(utime, nonce).second) return false;
  if (seen_.size() > limits_.remembered) forget_first();
  return true;
}

}  // namespace genio
