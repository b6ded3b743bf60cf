#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/closest_point.hpp"
#include "inverse/moved_target.hpp"
#include "inverse/target.hpp"

namespace genio {
namespace {

constexpr double outlier = 3;  // standard deviations

/// Fills a Residuals row by row and point by point.
class Builder {
 public:
  Builder(const MovedTarget& moved, double dof) : moved_(moved), dof_(dof) {}

  /// One residual: its value, its derivative with respect to nodes, and to the moved point (x, z).
  void row(double r, std::vector<std::pair<int, Vec3>> gradient, const Vec2& point,
           const Vec2& slope, double sigma, int axis = -1) {
    outliers_ += std::abs(r) > outlier;
    const SoftLoss soft(r, dof_);
    for (auto& [node, g] : gradient) g *= soft.slope;
    values_.push_back(soft.value);
    pose_.push_back(soft.slope * moved_.by_pose(point).transpose() * slope);
    gradient_.push_back(std::move(gradient));
    rows_.push_back({int(places_.size()), axis, soft.slope / sigma});
  }
  void point(double distance, const Vec3& place) {
    distances_.push_back(distance);
    places_.push_back(place);
  }
  Residuals result() && {
    Residuals r;
    r.values = Eigen::Map<const Vector>(values_.data(), Eigen::Index(values_.size()));
    r.distances = Eigen::Map<const Vector>(distances_.data(), Eigen::Index(distances_.size()));
    r.pose.resize(Eigen::Index(pose_.size()), 3);
    for (size_t k = 0; k < pose_.size(); ++k) r.pose.row(Eigen::Index(k)) = pose_[k].transpose();
    r.gradient = std::move(gradient_);
    r.places = std::move(places_);
    r.rows = std::move(rows_);
    r.outliers = outliers_;
    if (r.distances.size() > 0) {
      r.rms = std::sqrt(r.distances.squaredNorm() / double(r.distances.size()));
      r.max = r.distances.maxCoeff();
    }
    return r;
  }

 private:
  const MovedTarget& moved_;
  double dof_;
  std::vector<Residuals::Row> rows_;
  std::vector<double> values_, distances_;
  std::vector<Vec3> pose_, places_;
  std::vector<std::vector<std::pair<int, Vec3>>> gradient_;
  int outliers_ = 0;
};

void compare_curve(const CurvePoint& point, const TongueLine& line, const Positions& x,
                   const MovedTarget& moved, Builder& rows) {
  const Vec2 q = moved(point.position);
  const auto c = line.closest(x, q);
  const Vector w = line.weights(c.t);
  const auto& nodes = line.nodes();
  std::vector<std::pair<int, Vec3>> gradient;
  for (size_t k = 0; k < nodes.size(); ++k) {
    const Vec2 g = -w[Eigen::Index(k)] / point.sigma * c.normal;
    gradient.emplace_back(nodes[k], Vec3(g[0], 0, g[1]));
  }
  rows.row(c.distance / point.sigma, std::move(gradient), q, c.normal / point.sigma, point.sigma);
  const Vec2 foot = q - c.distance * c.normal;
  rows.point(std::abs(c.distance), Vec3(foot[0], 0, foot[1]));
}

void compare_flesh(const FleshPoint& point, const Positions& x, const MovedTarget& moved,
                   Builder& rows) {
  const Vec3 q = moved(point.position), on = point.on(x);
  Vec3 off = on - q;
  for (int i = 0; i < 3; ++i) {
    if (std::isnan(off[i])) {
      off[i] = 0;
      continue;
    }
    const Vec3 axis = Vec3::Unit(i) / point.sigma;
    std::vector<std::pair<int, Vec3>> gradient;
    for (const auto& [node, share] : point.at) gradient.emplace_back(node, share * axis);
    rows.row(off[i] / point.sigma, std::move(gradient), Vec2(q[0], q[2]), -Vec2(axis[0], axis[2]),
             point.sigma, i);
  }
  rows.point(off.norm(), on);
}

void compare_surface(const SurfacePoint& point, const std::vector<std::array<int, 3>>& triangles,
                     const Positions& x, const MovedTarget& moved, Builder& rows) {
  // Few hundred faces against few hundred points: a tree over a moving surface would not pay.
  const Vec3 q = moved(point.position);
  double best = std::numeric_limits<double>::infinity();
  size_t index = 0;
  std::array<double, 3> weight{};
  Vec3 foot = Vec3::Zero();
  for (size_t t = 0; t < triangles.size(); ++t) {
    const auto& n = triangles[t];
    const Vec3 a = node_position(x, n[0]), b = node_position(x, n[1]), c = node_position(x, n[2]);
    const auto w = closest_on_triangle(q, a, b, c);
    const Vec3 f = w[0] * a + w[1] * b + w[2] * c;
    if (const double d = (q - f).squaredNorm(); d < best) best = d, index = t, weight = w, foot = f;
  }
  const auto& n = triangles[index];
  const Vec3 face = (node_position(x, n[1]) - node_position(x, n[0]))
                        .cross(node_position(x, n[2]) - node_position(x, n[0]))
                        .normalized();
  // Signed along the line to the foot point, which is the face's normal inside a face.
  Vec3 normal = q - foot;
  const double distance = normal.norm();
  normal = distance > 1e-9 ? Vec3(normal / distance) : face;
  const double sign = normal.dot(face) >= 0 ? 1.0 : -1.0;
  const Vec3 slope = sign / point.sigma * normal;
  std::vector<std::pair<int, Vec3>> gradient;
  for (int k = 0; k < 3; ++k) gradient.emplace_back(n[size_t(k)], -weight[size_t(k)] * slope);
  rows.row(sign * distance / point.sigma, std::move(gradient), Vec2(q[0], q[2]),
           Vec2(slope[0], slope[2]), point.sigma);
  rows.point(distance, foot);
}

}  // namespace

Comparison::Comparison(const Model& model, Target target)
    : target_(std::move(target)), line_(model), rest_(model.rest), middle_(target_.middle()) {
  if (!target_.surface.empty())
    for (const Quad& q : model.surface) {
      triangles_.push_back({q[0], q[1], q[2]});
      triangles_.push_back({q[0], q[2], q[3]});
    }
  if (!target_.curve.empty()) nodes_ = line_.nodes();
  for (const auto& f : target_.flesh)
    for (const auto& [node, share] : f.at) nodes_.push_back(node);
  for (const auto& t : triangles_) nodes_.insert(nodes_.end(), t.begin(), t.end());
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
}

Residuals Comparison::operator()(const Positions& x, const HeadPose& pose) const {
  const MovedTarget moved(pose, middle_);
  Builder rows(moved, target_.outlier_dof);
  for (const auto& point : target_.curve) compare_curve(point, line_, x, moved, rows);
  for (const auto& point : target_.flesh) compare_flesh(point, x, moved, rows);
  for (const auto& point : target_.surface) compare_surface(point, triangles_, x, moved, rows);
  return std::move(rows).result();
}

Matrix model_error_covariance(const Residuals& residuals, double sd, double length) {
  const auto count = Eigen::Index(residuals.rows.size());
  Matrix c = Matrix::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const auto &a = residuals.rows[size_t(i)], &b = residuals.rows[size_t(j)];
      if (a.axis != b.axis) continue;
      const double apart =
          (residuals.places[size_t(a.point)] - residuals.places[size_t(b.point)]).squaredNorm();
      c(i, j) = c(j, i) = sd * sd * a.scale * b.scale * std::exp(-0.5 * apart / (length * length));
    }
  return c;
}

Matrix residual_jacobian(const Residuals& residuals, const Matrix& positions) {
  Matrix j = Matrix::Zero(Eigen::Index(residuals.gradient.size()), positions.cols());
  for (size_t i = 0; i < residuals.gradient.size(); ++i)
    for (const auto& [node, g] : residuals.gradient[i])
      j.row(Eigen::Index(i)) += g.transpose() * positions.middleRows<3>(3 * node);
  return j;
}

}  // namespace genio
