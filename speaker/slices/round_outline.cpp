#include "speaker/slices/round_outline.hpp"

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr double corner = 1.0472;   // [rad]
constexpr double straight = 0.005;  // [rad]
constexpr int most_between = 32;

}  // namespace

FlatOutline round_outline(const FlatOutline& outline, double step) {
  const size_t n = outline.size();
  // Slopes by the chord's length, behind each point and before it; they differ at a corner.
  std::vector<Eigen::Vector2d> behind(n), before(n);
  std::vector<double> turned(n);
  for (size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d in = outline[i] - outline[(i + n - 1) % n];
    const Eigen::Vector2d out = outline[(i + 1) % n] - outline[i];
    const double a = in.norm(), b = out.norm();
    const Eigen::Vector2d d0 = in / a, d1 = out / b;
    turned[i] = std::acos(std::clamp(d0.dot(d1), -1.0, 1.0));
    const Eigen::Vector2d slope = (d0 * b + d1 * a).normalized();
    before[i] = turned[i] > corner ? d0 : slope;
    behind[i] = turned[i] > corner ? d1 : slope;
  }
  FlatOutline result;
  for (size_t i = 0; i < n; ++i) {
    const size_t k = (i + 1) % n;
    const Eigen::Vector2d chord = outline[k] - outline[i];
    const double length = chord.norm();
    const bool curved =
        std::max(turned[i] > corner ? 0 : turned[i], turned[k] > corner ? 0 : turned[k]) > straight;
    // As long as an arc's slopes, so that a regular polygon's outline is its circle.
    const double angle =
        0.5 * ((turned[i] > corner ? 0 : turned[i]) + (turned[k] > corner ? 0 : turned[k]));
    const double reach =
        angle > straight ? length * 2 * std::tan(angle / 4) / std::sin(angle / 2) : length;
    const int pieces = curved ? std::clamp(int(std::ceil(length / step)), 4, most_between) : 1;
    for (int p = 0; p < pieces; ++p) {
      const double t = double(p) / pieces, s = 1 - t;
      result.push_back(outline[i] + t * t * (3 - 2 * t) * chord +
                       reach * t * s * (s * behind[i] - t * before[k]));
    }
  }
  return result;
}

}  // namespace genio
