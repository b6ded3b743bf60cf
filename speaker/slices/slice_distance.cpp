#include "speaker/slices/slice_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace genio {
namespace {

constexpr size_t bundle = 16;  // chords

double squared_to_chord(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  const double length = d.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * d).squaredNorm();
}

}  // namespace

SliceDistance::SliceDistance(const std::vector<FlatOutline>& outlines) {
  for (const FlatOutline& o : outlines)
    for (size_t i = 0; i < o.size(); ++i) chords_.push_back({o[i], o[(i + 1) % o.size()]});
  for (size_t first = 0; first < chords_.size(); first += bundle) {
    Bundle made{{}, first, std::min(first + bundle, chords_.size())};
    for (size_t i = made.first; i < made.last; ++i)
      made.box.extend(chords_[i].a).extend(chords_[i].b);
    bundles_.push_back(made);
  }
}

void SliceDistance::row(const std::vector<double>& u, double v, float* out) const {
  std::vector<double> crossed;
  for (const auto& [a, b] : chords_)
    if ((a[1] <= v) != (b[1] <= v))
      crossed.push_back(a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
  std::sort(crossed.begin(), crossed.end());
  double squared = std::numeric_limits<double>::infinity();
  size_t passed = 0;
  for (size_t i = 0; i < u.size(); ++i) {
    const Eigen::Vector2d p(u[i], v);
    if (i > 0) {  // no distance changes by more than the way
      const double most = std::sqrt(squared) + (u[i] - u[i - 1]);
      squared = most * most * (1 + 1e-12);
    }
    for (const Bundle& some : bundles_) {
      if (some.box.squaredExteriorDistance(p) >= squared) continue;
      for (size_t c = some.first; c < some.last; ++c)
        squared = std::min(squared, squared_to_chord(p, chords_[c].a, chords_[c].b));
    }
    while (passed < crossed.size() && crossed[passed] < u[i]) ++passed;
    out[i] = float(passed % 2 == 1 ? -std::sqrt(squared) : std::sqrt(squared));
  }
}

bool SliceDistance::inside(const Eigen::Vector2d& p) const {
  bool in = false;
  for (const auto& [a, b] : chords_)
    if ((a[1] <= p[1]) != (b[1] <= p[1]) &&
        a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) < p[0])
      in = !in;
  return in;
}

}  // namespace genio
