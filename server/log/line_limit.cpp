#include "server/log/line_limit.hpp"

#include <utility>

namespace genio {

bool LineLimit::passes(LogKind kind, double now) {
  Second& s = kinds_[size_t(kind)];
  if (s.begin < 0 || now >= s.begin + 1) s.begin = now, s.passed = 0;
  if (s.passed < most_) return ++s.passed, true;
  ++s.left_out;
  return false;
}

std::vector<LineLimit::LeftOut> LineLimit::take_left_out(double now, bool all) {
  std::vector<LeftOut> result;
  for (size_t k = 0; k < kinds_.size(); ++k) {
    Second& s = kinds_[k];
    if (s.left_out > 0 && (all || now >= s.begin + 1))
      result.push_back({LogKind(k), std::exchange(s.left_out, 0)});
  }
  return result;
}

}  // namespace genio
