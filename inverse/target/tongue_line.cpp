#include "inverse/target/tongue_line.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace genio {
namespace {

constexpr int samples_per_interval = 8;
constexpr double overhang = 0.02;  // how far the straight ends are searched [m]

}  // namespace

TongueLine::TongueLine(const Model& model) : nodes_(model.midsagittal) {
  const int n = int(nodes_.size());
  knots_ = Vector::Zero(n);
  for (int k = 1; k < n; ++k) {
    const Vec3 step = model.mesh.nodes[nodes_[k]] - model.mesh.nodes[nodes_[k - 1]];
    knots_[k] = knots_[k - 1] + Vec2(step[0], step[2]).norm();
    if (nodes_[k] == model.landmarks.tip) tip_ = knots_[k];
  }
  // Natural cubic spline: tridiagonal conditions on the second derivatives.
  Matrix a = Matrix::Identity(n, n), b = Matrix::Zero(n, n);
  for (int k = 1; k + 1 < n; ++k) {
    const double h0 = knots_[k] - knots_[k - 1], h1 = knots_[k + 1] - knots_[k];
    a(k, k - 1) = h0, a(k, k) = 2 * (h0 + h1), a(k, k + 1) = h1;
    b(k, k - 1) = 6 / h0, b(k, k) = -6 / h0 - 6 / h1, b(k, k + 1) = 6 / h1;
  }
  bend_ = a.partialPivLu().solve(b);
  const int count = samples_per_interval * n;
  dense_.resize(count + 1, n);
  for (int i = 0; i <= count; ++i)
    dense_.row(i) = weights(-overhang + (length() + 2 * overhang) * i / count);
}

Vector TongueLine::weights(double t, int derivative) const {
  const int n = int(knots_.size());
  const double inside = std::clamp(t, 0.0, length());
  if (t != inside)  // straight continuation
    return derivative == 0   ? Vector(weights(inside, 0) + (t - inside) * weights(inside, 1))
           : derivative == 1 ? weights(inside, 1)
                             : Vector(Vector::Zero(n));
  int i = int(std::upper_bound(knots_.begin(), knots_.end(), t) - knots_.begin());
  i = std::clamp(i, 1, n - 1);
  const double h = knots_[i] - knots_[i - 1], u = (knots_[i] - t) / h, v = 1 - u;
  Vector w = Vector::Zero(n);
  if (derivative == 0) {
    w[i - 1] = u, w[i] = v;
    w += h * h / 6 *
         ((u * u * u - u) * bend_.row(i - 1) + (v * v * v - v) * bend_.row(i)).transpose();
  } else if (derivative == 1) {
    w[i - 1] = -1 / h, w[i] = 1 / h;
    w += h / 6 * ((1 - 3 * u * u) * bend_.row(i - 1) + (3 * v * v - 1) * bend_.row(i)).transpose();
  } else {
    w = (u * bend_.row(i - 1) + v * bend_.row(i)).transpose();
  }
  return w;
}

Eigen::Matrix2Xd TongueLine::control(const Positions& x) const {
  Eigen::Matrix2Xd p(2, nodes_.size());
  for (size_t k = 0; k < nodes_.size(); ++k)
    p.col(Eigen::Index(k)) << x[3 * nodes_[k]], x[3 * nodes_[k] + 2];
  return p;
}

Vec2 TongueLine::point(const Positions& x, double t) const { return control(x) * weights(t); }

TongueLine::Closest TongueLine::closest(const Positions& x, const Vec2& q) const {
  const Eigen::Matrix2Xd p = control(x);
  const Eigen::Matrix2Xd line = p * dense_.transpose();
  Eigen::Index best = 0;
  (line.colwise() - q).colwise().squaredNorm().minCoeff(&best);
  const double spacing = (length() + 2 * overhang) / double(dense_.rows() - 1);
  const double low = -overhang + spacing * double(std::max<Eigen::Index>(best - 1, 0));
  const double high = low + 2 * spacing;
  double t = -overhang + spacing * double(best);
  double left = low, right = high;
  for (int i = 0; i < 40; ++i) {  // Newton on (c - q) . c' = 0, kept inside the bracket
    const Vec2 c = p * weights(t, 0), d = p * weights(t, 1), dd = p * weights(t, 2);
    const double g = (c - q).dot(d), h = d.squaredNorm() + (c - q).dot(dd);
    if (g > 0) right = std::min(right, t);
    else left = std::max(left, t);
    double next = h > 0 ? t - g / h : 0.5 * (left + right);
    if (!(next >= left && next <= right)) next = 0.5 * (left + right);
    const bool done = std::abs(next - t) < 1e-13;
    t = next;
    if (done) break;
  }
  const Vec2 tangent = (p * weights(t, 1)).normalized();
  // From below the tip over the dorsum to the root the outside lies to the left (x back, z up).
  const Vec2 normal(-tangent[1], tangent[0]);
  return {t, normal.dot(q - Vec2(p * weights(t, 0))), normal};
}

std::vector<Vec2> TongueLine::sample(const Positions& x, int count) const {
  const Eigen::Matrix2Xd p = control(x);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) points.push_back(p * weights(length() * i / (count - 1)));
  return points;
}

std::string tongue_region(const TongueLine& line, const Positions& x, const Vec3& place) {
  const double t = line.closest(x, Vec2(place[0], place[2])).t;
  const double from_tip = (t - line.tip_parameter()) / (line.length() - line.tip_parameter());
  return from_tip < 0      ? "underside"
         : from_tip < 0.1  ? "tip"
         : from_tip < 0.3  ? "blade"
         : from_tip < 0.65 ? "dorsum"
                           : "root";
}

}  // namespace genio
