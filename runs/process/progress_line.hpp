#pragma once
#include <string>

#include "forward/base/elapsed.hpp"

namespace genio {

/// A bar with counts and the time that is left, on standard error: in place on a terminal, a line
/// every tenth part elsewhere. Nothing for a single item.
class ProgressLine {
 public:
  ProgressLine(int done, int total, std::string items = "frames");
  void step();

 private:
  std::string items_;
  int first_, done_, total_;
  bool terminal_;
  Stopwatch watch_;
};

/// A line that says how far a single piece of work is, `part` 0 to 1, and what it does; on standard
/// error, in place on a terminal.
void print_progress(double part, const std::string& what);

/// Says how far a single piece of work is once it has taken two seconds, at every tenth part.
class LongWork {
 public:
  explicit LongWork(std::string what);
  void operator()(double part);

 private:
  std::string what_;
  int tenth_ = 0;
  Stopwatch watch_;
};

}  // namespace genio
