#include "forward/base/elapsed.hpp"

#include <chrono>

namespace genio {

double Stopwatch::now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double Stopwatch::seconds() const { return now() - started_; }

}  // namespace genio
