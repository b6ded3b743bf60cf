#include "inverse/target/comparison.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "forward/model/at_anatomy.hpp"
#include "inverse/target/moved_target.hpp"

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
  // r^2 = (across / sigma)^2 + (past the end / end_sigma)^2, with the sign of across.
  const double across = c.distance / point.sigma, past = point.past_end(c.beyond);
  Vec2 slope = c.normal / point.sigma;  // dr / dq
  double r = across;
  std::vector<Vec2> of_end(nodes.size(), Vec2::Zero());  // - d beyond / d node
  Vec2 end = q - c.distance * c.normal;
  if (c.beyond != 0) {
    const double t = std::clamp(c.t, 0.0, line.length()), end_sigma = point.past_end_sigma();
    const Vector at = line.weights(t), turns = line.weights(t, 1);
    const Vec2 along = line.control(x) * turns, tangent = along.normalized();
    end -= c.beyond * tangent;
    if (past != 0) {
      r = std::copysign(std::hypot(across, past / end_sigma), across);
      const double part = past / (end_sigma * end_sigma * r);
      slope = across / r * slope + part * tangent;
      for (size_t k = 0; k < nodes.size(); ++k)
        of_end[k] = part * (at[Eigen::Index(k)] * tangent -
                            c.distance / along.norm() * turns[Eigen::Index(k)] * c.normal);
    }
  }
  std::vector<std::pair<int, Vec3>> gradient;
  for (size_t k = 0; k < nodes.size(); ++k) {
    const Vec2 g =
        -(across == r ? 1 : across / r) * w[Eigen::Index(k)] / point.sigma * c.normal - of_end[k];
    gradient.emplace_back(nodes[k], Vec3(g[0], 0, g[1]));
  }
  rows.row(r, std::move(gradient), q, slope, point.sigma);
  rows.point(std::hypot(c.distance, past), Vec3(end[0], 0, end[1]));
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

/// The signed distance of q from a facet, and its derivative with respect to q.
double signed_distance(const Vec3& q, const std::array<Vec3, 3>& corners, const Foot& foot,
                       Vec3& slope) {
  const Vec3 face = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  // Signed along the line to the foot point, which is the face's normal inside a face.
  const double distance = std::sqrt(foot.square);
  const Vec3 normal = distance > 1e-9 ? Vec3((q - foot.place) / distance) : face;
  const double sign = normal.dot(face) >= 0 ? 1.0 : -1.0;
  slope = sign * normal;
  return sign * distance;
}

/// `about`: where the distance is taken, from the point; the mean counts. The gradient begins with
/// the nodes of the first one's facet.
void compare_surface(const SurfacePoint& point, const FacetSurface& surface,
                     const std::vector<Vec3>& about, const MovedTarget& moved, Builder& rows) {
  const Vec3 q = moved(point.position);
  const size_t nearest = surface.nearest(q);
  const Foot foot = surface.foot(nearest, q);
  std::vector<size_t> near{nearest};
  if (about.size() > 1)
    near = surface.within(q, std::sqrt(foot.square) + 2.01 * about.front().norm());
  const double share = 1 / (point.sigma * double(about.size()));
  double r = 0;
  Vec3 slope = Vec3::Zero();
  std::vector<std::pair<int, Vec3>> gradient;
  for (const Vec3& offset : about) {
    const Vec3 p = q + offset;
    size_t best = near.front();
    Foot least = surface.foot(best, p);
    for (size_t k = 1; k < near.size(); ++k)
      if (const Foot f = surface.foot(near[k], p); f.square < least.square)
        least = f, best = near[k];
    Vec3 direction;
    r += share * signed_distance(p, surface.corners(best), least, direction);
    slope += share * direction;
    const auto shares = node_shares(least.weight);
    for (size_t k = 0; k < 4; ++k) {
      const int node = surface.nodes(best)[k];
      const Vec3 g = -shares[k] * share * direction;
      const auto known = std::find_if(gradient.begin(), gradient.end(),
                                      [&](const auto& entry) { return entry.first == node; });
      if (known == gradient.end()) gradient.emplace_back(node, g);
      else known->second += g;
    }
  }
  rows.row(r, std::move(gradient), Vec2(q[0], q[2]), Vec2(slope[0], slope[2]), point.sigma);
  rows.point(std::abs(r) * point.sigma, foot.place);
}

/// The corners of an icosahedron of radius r, or its middle where that is 0.
std::vector<Vec3> icosahedron(double r) {
  if (r == 0) return {Vec3::Zero()};
  std::vector<Vec3> corners;
  const double golden = std::numbers::phi, size = r / std::hypot(1.0, golden);
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden}) {
      corners.push_back(size * Vec3(0, a, b));
      corners.push_back(size * Vec3(a, b, 0));
      corners.push_back(size * Vec3(b, 0, a));
    }
  return corners;
}

}  // namespace

Comparison::Comparison(const Model& model, Target target, double smoothing)
    : target_(std::move(target)),
      line_(model),
      rest_(at_anatomy(model)->rest),
      about_(icosahedron(smoothing)),
      middle_(target_.middle()) {
  if (!target_.surface.empty()) facets_ = facets(model.surface);
  if (!target_.curve.empty()) nodes_ = line_.nodes();
  for (const auto& f : target_.flesh)
    for (const auto& [node, share] : f.at) nodes_.push_back(node);
  for (const Facet& f : facets_) nodes_.insert(nodes_.end(), f.begin(), f.end());
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
}

Residuals Comparison::operator()(const Positions& x, const HeadPose& pose) const {
  const MovedTarget moved(pose, middle_);
  Builder rows(moved, target_.outlier_dof);
  for (const auto& point : target_.curve) compare_curve(point, line_, x, moved, rows);
  for (const auto& point : target_.flesh) compare_flesh(point, x, moved, rows);
  const FacetSurface surface(facets_, x);
  for (const auto& point : target_.surface) compare_surface(point, surface, about_, moved, rows);
  return std::move(rows).result();
}

Matrix model_error_covariance(const Residuals& residuals, double sd, double length) {
  return model_error_covariance(residuals,
                                Vector::Constant(Eigen::Index(residuals.rows.size()), sd), length);
}

Matrix model_error_covariance(const Residuals& residuals, const Vector& sd, double length) {
  const auto count = Eigen::Index(residuals.rows.size());
  Matrix c = Matrix::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const auto &a = residuals.rows[size_t(i)], &b = residuals.rows[size_t(j)];
      if (a.axis != b.axis) continue;
      const double apart =
          (residuals.places[size_t(a.point)] - residuals.places[size_t(b.point)]).squaredNorm();
      c(i, j) = c(j, i) =
          sd[i] * sd[j] * a.scale * b.scale * std::exp(-0.5 * apart / (length * length));
    }
  return c;
}

Vector ways_from_rest(const Residuals& residuals, const Positions& x, const Positions& rest) {
  Vector ways(Eigen::Index(residuals.gradient.size()));
  for (size_t i = 0; i < residuals.gradient.size(); ++i) {
    Vec3 moved = Vec3::Zero();
    double weight = 0;
    for (const auto& [node, g] : residuals.gradient[i])
      moved += g.norm() * (node_position(x, node) - node_position(rest, node)), weight += g.norm();
    ways[Eigen::Index(i)] = weight > 0 ? moved.norm() / weight : 0;
  }
  return ways;
}

Matrix unabsorbed_error(const Residuals& residuals, const ModelError& error, double way,
                        const Vector& ways) {
  const Vector own = (error.left * ways).cwiseMax(error.least);
  Matrix c = model_error_covariance(residuals, own, error.left_length);
  if (error.left_of_another > 0)
    c += model_error_covariance(residuals, error.left_of_another * way, error.length);
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
