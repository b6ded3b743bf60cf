#pragma once
#include <array>
#include <vector>

#include "server/log/log_event.hpp"

namespace genio {

/// Lets so many lines of a kind pass in a second, and counts the others. Times [s] never turn back.
class LineLimit {
 public:
  explicit LineLimit(int a_second) : most_(a_second) {}

  /// True where a line of the kind may be written at the time.
  bool passes(LogKind kind, double now);

  struct LeftOut {
    LogKind kind;
    int64_t lines;
  };
  /// What was left out in seconds that are over, each told once. `all`: also in those that last.
  std::vector<LeftOut> take_left_out(double now, bool all = false);

 private:
  struct Second {
    double begin = -1;
    int passed = 0;
    int64_t left_out = 0;
  };
  int most_;
  std::array<Second, size_t(LogKind::count)> kinds_;
};

}  // namespace genio
