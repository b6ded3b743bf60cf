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

/// Processor time of this process, all threads, user and system [s].
double processor_seconds();

/// The same of all processes that ended below this one.
double children_seconds();

}  // namespace genio
