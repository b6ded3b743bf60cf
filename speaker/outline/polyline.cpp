#include "speaker/outline/polyline.hpp"

#include <algorithm>
#include <limits>

namespace genio {

Polyline::Polyline(std::vector<Vec2> points) : points_(std::move(points)), arc_(1, 0.0) {
  for (size_t k = 1; k < points_.size(); ++k)
    arc_.push_back(arc_.back() + (points_[k] - points_[k - 1]).norm());
}

size_t Polyline::segment(double s) const {
  const auto after = std::upper_bound(arc_.begin(), arc_.end(), s);
  return size_t(
      std::clamp<std::ptrdiff_t>(after - arc_.begin(), 1, std::ptrdiff_t(arc_.size()) - 1));
}

Vec2 Polyline::at(double s) const {
  s = std::clamp(s, 0.0, length());
  const size_t k = segment(s);
  const double gap = arc_[k] - arc_[k - 1];
  const double part = gap > 0 ? (s - arc_[k - 1]) / gap : 0;
  return (1 - part) * points_[k - 1] + part * points_[k];
}

double Polyline::position(double s) const {
  const size_t k = segment(s);
  return double(k - 1) + (s - arc_[k - 1]) / (arc_[k] - arc_[k - 1]);
}

double Polyline::arc_at(double position) const {
  const size_t k = std::min(size_t(std::max(position, 0.0)), arc_.size() - 2);
  return arc_[k] + (position - double(k)) * (arc_[k + 1] - arc_[k]);
}

Vec2 Polyline::tangent(double s) const {
  const size_t k = segment(std::clamp(s, 0.0, length()));
  return (points_[k] - points_[k - 1]).normalized();
}

Polyline::Foot Polyline::foot(const Vec2& q, double from, double to) const {
  from = std::clamp(from, 0.0, length()), to = std::clamp(to, from, length());
  Foot best{from, at(from), std::numeric_limits<double>::infinity()};
  for (size_t k = segment(from); k <= segment(to); ++k) {
    const Vec2 way = points_[k] - points_[k - 1];
    const double gap = arc_[k] - arc_[k - 1];
    if (!(gap > 0)) continue;
    const double s = std::clamp(arc_[k - 1] + (q - points_[k - 1]).dot(way) / gap,
                                std::max(from, arc_[k - 1]), std::min(to, arc_[k]));
    const Vec2 place = points_[k - 1] + (s - arc_[k - 1]) / gap * way;
    const double distance = (q - place).norm();
    if (distance < best.distance) best = {s, place, distance};
  }
  return best;
}

bool sides_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto turn = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  };
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

double doubled_area(const std::vector<Vec2>& closed) {
  double sum = 0;
  for (size_t k = 0; k < closed.size(); ++k) {
    const Vec2 &a = closed[k], &b = closed[(k + 1) % closed.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

}  // namespace genio
