#include "data/generator/outline.hpp"

#include <algorithm>
#include <cmath>

namespace genio::generic {
namespace {

/// Second derivatives of the natural cubic spline through `points` at `knots`.
std::vector<Point2> spline_bend(const std::vector<double>& knots,
                                const std::vector<Point2>& points) {
  const size_t n = points.size();
  std::vector<Point2> m(n, Point2::Zero()), right(n, Point2::Zero());
  std::vector<double> diagonal(n, 1.0), upper(n, 0.0);
  for (size_t i = 1; i + 1 < n; ++i) {  // Thomas elimination on the fly
    const double h0 = knots[i] - knots[i - 1], h1 = knots[i + 1] - knots[i];
    const Point2 b = 6 * ((points[i + 1] - points[i]) / h1 - (points[i] - points[i - 1]) / h0);
    const double factor = h0 / diagonal[i - 1];
    diagonal[i] = 2 * (h0 + h1) - factor * upper[i - 1];
    upper[i] = h1;
    right[i] = b - factor * right[i - 1];
  }
  for (size_t i = n - 2; i > 0; --i) m[i] = (right[i] - upper[i] * m[i + 1]) / diagonal[i];
  return m;
}

}  // namespace

Curve::Curve(std::vector<Point2> points) : points_(std::move(points)) {
  knots_.push_back(0);
  for (size_t i = 1; i < points_.size(); ++i)
    knots_.push_back(knots_.back() + (points_[i] - points_[i - 1]).norm());
  bend_ = spline_bend(knots_, points_);
  constexpr int samples = 2000;
  arc_.assign(1, 0.0);
  for (int i = 1; i <= samples; ++i)
    arc_.push_back(
        arc_.back() +
        (raw(knots_.back() * i / samples) - raw(knots_.back() * (i - 1) / samples)).norm());
  length_ = arc_.back();
}

Point2 Curve::raw(double t) const {
  size_t i = size_t(std::upper_bound(knots_.begin(), knots_.end(), t) - knots_.begin());
  i = std::clamp<size_t>(i, 1, knots_.size() - 1);
  const double h = knots_[i] - knots_[i - 1], a = (knots_[i] - t) / h, b = 1 - a;
  return a * points_[i - 1] + b * points_[i] +
         h * h / 6 * ((a * a * a - a) * bend_[i - 1] + (b * b * b - b) * bend_[i]);
}

Point2 Curve::at(double u) const {
  const double target = std::clamp(u, 0.0, 1.0) * length_;
  size_t i = size_t(std::lower_bound(arc_.begin(), arc_.end(), target) - arc_.begin());
  i = std::clamp<size_t>(i, 1, arc_.size() - 1);
  const double part = (target - arc_[i - 1]) / (arc_[i] - arc_[i - 1]);
  return raw(knots_.back() * (double(i - 1) + part) / double(arc_.size() - 1));
}

Point2 Curve::left_normal(double u) const {
  const Point2 t = (at(std::min(1.0, u + 0.02)) - at(std::max(0.0, u - 0.02))).normalized();
  return {-t[1], t[0]};
}

double blend(const std::vector<Point2>& table, double u) {
  if (u <= table.front()[0]) return table.front()[1];
  for (size_t i = 1; i < table.size(); ++i)
    if (u <= table[i][0]) {
      const double t = (u - table[i - 1][0]) / (table[i][0] - table[i - 1][0]);
      return table[i - 1][1] + (table[i][1] - table[i - 1][1]) * t * t * (3 - 2 * t);
    }
  return table.back()[1];
}

// Landmarks: tip, dorsum top, base, ends of SL, GH and GG, hyoid and chin of the published tables
// (docs/generic.md lists each with its source); the points between them only keep the curve smooth.

Curve surface_line() {
  return Curve({{60.0, 92.8},
                {57.2, 96.4},
                {58.6, 100.8},
                {66.5, 106.0},
                {80.0, 111.2},
                {94.8, 113.7},
                {110.0, 110.5},
                {121.5, 100.5},
                {127.4, 88.1},
                {127.6, 76.0},
                {123.0, 66.5},
                {115.5, 60.5},
                {107.5, 55.5}});
}

Curve front_line() {
  return Curve({{70.5, 88.6},
                {74.5, 88.2},
                {77.5, 86.0},
                {78.6, 80.5},
                {77.8, 72.0},
                {77.0, 64.0},
                {76.0, 56.5}});
}

Curve palate_line() {
  return Curve({{50.0, 101.0},
                {53.5, 107.0},
                {62.0, 111.5},
                {73.0, 117.5},
                {85.0, 121.2},
                {97.0, 122.0},
                {110.0, 119.0},
                {121.0, 113.5},
                {130.0, 105.0},
                {135.5, 93.0},
                {137.5, 78.0},
                {137.0, 60.0}});
}

Curve jaw_line() {
  return Curve(
      {{74.5, 54.0}, {75.3, 63.0}, {74.6, 72.0}, {67.0, 82.0}, {57.5, 90.5}, {53.0, 95.0}});
}

double half_width(double u, double depth) {
  const double at_surface = blend({{0.0, 9.5},
                                   {0.05, 10.0},
                                   {0.16, 17.0},
                                   {0.30, 21.5},
                                   {0.45, 23.5},
                                   {0.62, 26.0},
                                   {0.80, 30.0},
                                   {1.0, 24.0}},
                                  u);
  const double at_front = blend({{0.0, 8.5}, {0.4, 9.5}, {1.0, 9.5}}, u);
  // The lower, rear part spreads towards the mandible before it narrows to the hyoid.
  const double spread = blend({{0.55, 0.0}, {0.8, 4.0}, {1.0, 5.0}}, u) * 4 * depth * (1 - depth);
  return at_front + (at_surface - at_front) * depth + spread;
}

}  // namespace genio::generic
