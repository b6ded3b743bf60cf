#pragma once
#include <string>

namespace genio::cli {

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
  double started_;
};

}  // namespace genio::cli
