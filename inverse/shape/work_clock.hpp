#pragma once
#include "forward/base/elapsed.hpp"
#include "inverse/shape/infer.hpp"

namespace genio {

/// How long a piece of work has run, and whether its requester still wants it. Once stopped it
/// stays so. `options` must outlive it.
class WorkClock {
 public:
  explicit WorkClock(const InferOptions& options) : options_(options) {}

  double seconds() const { return watch_.seconds(); }
  bool stopped() {
    if (reason_ != InferStatus::converged) return true;
    if (options_.cancelled && options_.cancelled()) reason_ = InferStatus::cancelled;
    else if (options_.deadline_s > 0 && seconds() > options_.deadline_s)
      reason_ = InferStatus::deadline;
    return reason_ != InferStatus::converged;
  }
  /// Why it stopped; converged while it has not.
  InferStatus reason() const { return reason_; }

 private:
  const InferOptions& options_;
  Stopwatch watch_;
  InferStatus reason_ = InferStatus::converged;
};

}  // namespace genio
