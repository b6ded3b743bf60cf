#include "server/hub/turns/usage.hpp"

#include <cmath>

namespace genio {
namespace {

constexpr double usage_half_life_s = 1;
// A client that sends a hundred short messages a second stays below.
constexpr double much_s = 0.003, little_s = 0.001;
constexpr std::chrono::seconds remembered{1};

}  // namespace

void HubUsage::add(double more, bool had_more, HubTime now) {
  used_ = at(now) + more;
  at_ = now;
  if (had_more) had_more_ = now;
}

double HubUsage::at(HubTime now) const {
  return used_ * std::exp2(-std::chrono::duration<double>(now - at_).count() / usage_half_life_s);
}

bool HubUsage::is_much(HubTime now, bool before) const {
  return had_more_ && now - *had_more_ < remembered && at(now) > (before ? little_s : much_s);
}

}  // namespace genio
