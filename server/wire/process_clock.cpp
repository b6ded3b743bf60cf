#include "server/wire/process_clock.hpp"

#include <chrono>

#include "server/wire/wire.hpp"

namespace genio {
namespace {

int64_t steady_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

int64_t process_us() {
  static const int64_t lead = now_us() - steady_us();
  return steady_us() + lead;
}

int64_t wall_lead_us() { return now_us() - process_us(); }

}  // namespace genio
