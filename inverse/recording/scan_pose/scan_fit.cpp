#include "inverse/recording/scan_pose/scan_fit.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace genio {
namespace {

constexpr double bent_sd = 2.5e-3;        // of a scan about a surface that is bent to it [m]
constexpr double palate_sd = 2e-3;        // of a palate about the model's [m]
constexpr double independent_trace = 42;  // points of a palate
constexpr double free_scale_sd = 1;       // of the logarithm
constexpr double turn_sd = 20 * std::numbers::pi / 180;
constexpr double enough = 1e-3;  // fall of the cost in a step that is worth another

struct Place {
  Vec3 turn = Vec3::Zero();  // from the start, as a rotation vector
  double log_scale = 0;
  Vec3 middle = Vec3::Zero();
  Vector bend;
};

struct Frame {
  const ScanProblem& problem;
  Mat3 start;  // the rotation that Place::turn counts from

  Mat3 turn(const Place& at) const {
    const double angle = at.turn.norm();
    if (angle == 0) return start;
    return Eigen::AngleAxisd(angle, at.turn / angle).toRotationMatrix() * start;
  }
  ScanPose pose(const Place& at) const {
    ScanPose p{.scale = std::exp(at.log_scale), .turn = turn(at)};
    p.shift = at.middle - p.scale * (p.turn * problem.centre);
    return p;
  }
  Positions shape(const Place& at) const {
    Positions x = problem.reach.rest;
    for (Eigen::Index k = 0; k < at.bend.size(); ++k)
      x += at.bend[k] * problem.reach.modes[size_t(k)];
    return x;
  }
};

struct Weights {
  double tongue, palate;  // of a squared distance [1/m^2]
};

/// Distances count in the scan's own lengths, else what fits badly would shrink.
Weights weights_of(const ScanProblem& p, const Place& at) {
  const double lengths = std::exp(-2 * at.log_scale);
  const auto each = [&](double independent, size_t count, double sd) {
    return lengths * independent / std::max<double>(1, double(count)) / (sd * sd);
  };
  return {each(p.weight, p.points.size(), bent_sd),
          each(std::min(independent_trace, double(p.trace.size())), p.trace.size(), palate_sd)};
}

double scale_weight(const ScanProblem& p) {
  const double sd = p.free ? free_scale_sd : p.reach.scale_sd;
  return 1 / (sd * sd);
}

/// The cost and the equations of Gauss and Newton; the shape's unknowns follow the pose's.
struct Normal {
  double cost = 0;
  Matrix a;
  Vector g;
  void add(const Vector& row, double residual, double weight) {
    a.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    g += weight * residual * row;
  }
};

/// How an offset's part along n turns with the pose, in the scan's own lengths.
Vector row_of(const Vec3& arm, const Vec3& n, double residual, Eigen::Index size) {
  Vector row = Vector::Zero(size);
  row.head<3>() = arm.cross(n);
  row[3] = n.dot(arm) - residual;
  row.segment<3>(4) = n;
  return row;
}

void add_tongue(Normal& normal, const Frame& f, const Place& at, const ScanPose& pose,
                double weight) {
  const SurfaceReach& reach = f.problem.reach;
  const Positions shape = f.shape(at);
  const FacetSurface surface(reach.facets, shape);
  for (const Vec3& q : f.problem.points) {
    const Vec3 moved = pose(q);
    const size_t facet = surface.nearest(moved);
    const Foot foot = surface.foot(facet, moved);
    const auto& [a, b, c] = surface.corners(facet);
    const Vec3 n = (b - a).cross(c - a).normalized();
    const double residual = n.dot(moved - foot.place);
    normal.cost += weight * foot.square;
    Vector row = row_of(moved - at.middle, n, residual, normal.g.size());
    const Facet& nodes = surface.nodes(facet);
    const auto shares = node_shares(foot.weight);
    for (Eigen::Index k = 0; k < at.bend.size(); ++k)
      for (size_t i = 0; i < 4; ++i)
        row[pose_size + k] -= shares[i] * n.dot(node_position(reach.modes[size_t(k)], nodes[i]));
    normal.add(row, residual, weight);
  }
}

void add_palate(Normal& normal, const Frame& f, const Place& at, const ScanPose& pose,
                double weight) {
  for (const Vec3& q : f.problem.trace) {
    const Vec3 moved = pose(q), arm = moved - at.middle;
    const auto foot = f.problem.palate->foot(moved);
    const Vec3 off = moved - foot.place;
    normal.cost += weight * off.squaredNorm();
    const auto along = [&](const Vec3& n) {
      normal.add(row_of(arm, n, n.dot(off), normal.g.size()), n.dot(off), weight);
    };
    if (foot.on_rim)
      for (int i = 0; i < 3; ++i) along(Vec3::Unit(i));
    else along(foot.normal.normalized());
  }
}

Normal normal_of(const Frame& f, const Place& at) {
  const ScanProblem& p = f.problem;
  const Eigen::Index size = pose_size + at.bend.size();
  Normal n{0, Matrix::Zero(size, size), Vector::Zero(size)};
  const ScanPose pose = f.pose(at);
  const Vec3 turn = rotation_vector(pose.turn * p.level.transpose());
  const double turning = 1 / (turn_sd * turn_sd), scaling = scale_weight(p);
  n.cost =
      turning * turn.squaredNorm() + scaling * at.log_scale * at.log_scale + at.bend.squaredNorm();
  n.a.diagonal().head<3>().setConstant(turning);
  n.g.head<3>() = turning * turn;
  n.a(3, 3) = scaling, n.g[3] = scaling * at.log_scale;
  n.a.diagonal().tail(at.bend.size()).setOnes();
  n.g.tail(at.bend.size()) = at.bend;
  const Weights w = weights_of(p, at);
  add_tongue(n, f, at, pose, w.tongue);
  add_palate(n, f, at, pose, w.palate);
  n.a.triangularView<Eigen::StrictlyUpper>() = n.a.transpose();
  return n;
}

}  // namespace

Vec3 rotation_vector(const Mat3& rotation) {
  const Eigen::AngleAxisd a(rotation);
  return a.angle() * a.axis();
}

ScanFit fit_scan(const ScanProblem& problem, const ScanPose& pose, bool bends, int most_steps) {
  Frame frame{problem, pose.turn};
  Place at{.log_scale = std::log(pose.scale),
           .middle = pose(problem.centre),
           .bend = Vector::Zero(bends ? Eigen::Index(problem.reach.modes.size()) : 0)};
  Normal here = normal_of(frame, at);
  double damping = 1e-3;
  for (int k = 0; k < most_steps && damping < 1e5; ++k) {
    Matrix a = here.a;
    a.diagonal() *= 1 + damping;
    const Vector step = -a.ldlt().solve(here.g);
    Place next = at;
    next.turn = step.head<3>();
    next.log_scale += step[3], next.middle += step.segment<3>(4);
    next.bend += step.tail(at.bend.size());
    Normal there = normal_of(frame, next);
    if (!(there.cost < here.cost)) {
      damping *= 10;
      continue;
    }
    const double fall = here.cost - there.cost;
    frame.start = frame.turn(next), next.turn.setZero();
    at = next, here = std::move(there), damping = std::max(damping / 5, 1e-8);
    if (fall < enough) break;
  }
  ScanFit fit{.cost = here.cost, .pose = frame.pose(at), .shape = frame.shape(at)};
  const Matrix covariance = here.a.ldlt().solve(Matrix::Identity(here.a.rows(), here.a.rows()));
  fit.spread = covariance.topLeftCorner<pose_size, pose_size>();
  return fit;
}

}  // namespace genio
