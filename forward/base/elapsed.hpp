#pragma once

namespace genio {

/// How long something has lasted, by a clock that never turns back.
class Stopwatch {
 public:
  /// Time since it was made [s].
  double seconds() const;

 private:
  static double now();
  double started_ = now();
};

}  // namespace genio
