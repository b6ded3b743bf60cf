#include "inverse/target/tongue_line.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr int samples_per_interval = 8;
constexpr double rounding = 1.5e-3;  // on both sides of a corner [m]

}  // namespace

TongueLine::TongueLine(const Model& model) : nodes_(model.midsagittal) {
  const int n = int(nodes_.size());
  knots_ = Vector::Zero(n);
  for (int k = 1; k < n; ++k) {
    const Vec3 step = model.mesh.nodes[nodes_[k]] - model.mesh.nodes[nodes_[k - 1]];
    knots_[k] = knots_[k - 1] + Vec2(step[0], step[2]).norm();
    if (nodes_[k] == model.landmarks.tip) tip_ = knots_[k];
  }
  const int count = samples_per_interval * n;
  dense_.resize(count + 1, n);
  for (int i = 0; i <= count; ++i) dense_.row(i) = weights(length() * i / count);
}

Vector TongueLine::weights(double t, int derivative) const {
  const int n = int(knots_.size());
  Vector w = Vector::Zero(n);
  const int i =
      std::clamp(int(std::upper_bound(knots_.begin(), knots_.end(), t) - knots_.begin()), 1, n - 1);
  const double h = knots_[i] - knots_[i - 1];
  if (derivative == 0) w[i - 1] = (knots_[i] - t) / h, w[i] = (t - knots_[i - 1]) / h;
  if (derivative == 1) w[i - 1] = -1 / h, w[i] = 1 / h;
  // What rounding adds at a corner times the change of slope there.
  for (int k = 1; k + 1 < n; ++k) {
    const double s = t - knots_[k], left = rounding - std::abs(s);
    if (left <= 0) continue;
    const double square = rounding * rounding;
    const double added = derivative == 0   ? left * left * left / (6 * square)
                         : derivative == 1 ? (s < 0 ? 1 : -1) * left * left / (2 * square)
                                           : left / square;
    const double before = knots_[k] - knots_[k - 1], after = knots_[k + 1] - knots_[k];
    w[k - 1] += added / before, w[k] -= added / before + added / after, w[k + 1] += added / after;
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
  const double spacing = length() / double(dense_.rows() - 1);
  double t = spacing * double(best);
  double left = t - spacing, right = t + spacing;
  // The straight ends go on for ever.
  if (best == 0) left = -1e9;
  if (best + 1 == dense_.rows()) right = 1e9;
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
  const Vec2 along = p * weights(t, 1), tangent = along.normalized();
  // From below the tip over the dorsum to the root the outside lies to the left (x back, z up).
  const Vec2 normal(-tangent[1], tangent[0]);
  const double beyond = (t - std::clamp(t, 0.0, length())) * along.norm();
  return {t, normal.dot(q - Vec2(p * weights(t, 0))), normal, beyond};
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
