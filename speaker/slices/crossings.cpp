#include "speaker/slices/crossings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace genio {
namespace {

struct Side {
  Eigen::Vector2d a, b;
  size_t outline, index;
};

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// True where two sides have a point in common.
bool meet(const Side& s, const Side& t) {
  const double d1 = turn(s.a, s.b, t.a), d2 = turn(s.a, s.b, t.b);
  const double d3 = turn(t.a, t.b, s.a), d4 = turn(t.a, t.b, s.b);
  if (d1 == 0 && d2 == 0 && d3 == 0 && d4 == 0) {  // on one line
    for (int d = 0; d < 2; ++d)
      if (std::max(s.a[d], s.b[d]) < std::min(t.a[d], t.b[d]) ||
          std::max(t.a[d], t.b[d]) < std::min(s.a[d], s.b[d]))
        return false;
    return true;
  }
  return d1 * d2 <= 0 && d3 * d4 <= 0;
}

/// Of a corner's two sides: true where the second runs back over the first.
bool runs_back(const Side& s, const Side& t) {
  return turn(s.a, s.b, t.b) == 0 && (s.b - s.a).dot(t.b - t.a) < 0;
}

}  // namespace

std::string crossing_fault(const std::vector<std::vector<Eigen::Vector2d>>& outlines) {
  std::vector<Side> sides;
  for (size_t o = 0; o < outlines.size(); ++o)
    for (size_t i = 0; i < outlines[o].size(); ++i)
      sides.push_back({outlines[o][i], outlines[o][(i + 1) % outlines[o].size()], o, i});
  const auto left = [](const Side& s) { return std::min(s.a[0], s.b[0]); };
  std::sort(sides.begin(), sides.end(),
            [&](const Side& s, const Side& t) { return left(s) < left(t); });
  for (size_t i = 0; i < sides.size(); ++i) {
    const double right = std::max(sides[i].a[0], sides[i].b[0]);
    for (size_t k = i + 1; k < sides.size() && left(sides[k]) <= right; ++k) {
      const Side &s = sides[i], &t = sides[k];
      const size_t n = outlines[s.outline].size();
      const bool same = s.outline == t.outline;
      bool faulty;
      if (same && (s.index + 1) % n == t.index) faulty = runs_back(s, t);
      else if (same && (t.index + 1) % n == s.index) faulty = runs_back(t, s);
      else faulty = meet(s, t);
      if (faulty)
        return fmt::format("{} near point {}; expected outlines that do not cross",
                           same ? "an outline crosses or touches itself"
                                : "two outlines cross or touch each other",
                           std::min(s.index, t.index) + 1);
    }
  }
  return "";
}

}  // namespace genio
