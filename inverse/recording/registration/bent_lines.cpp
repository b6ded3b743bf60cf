#include "inverse/recording/registration/bent_lines.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace genio {
namespace {

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;
using Rows4 = Eigen::Matrix<double, 2, 4>;

constexpr double bent_sd = 2.5e-3;  // of contours about a line that is bent to them [m]
constexpr double shape_frames = 3;  // whose shapes count
constexpr int most_steps = 60;
constexpr double enough = 1e-4;  // fall of the cost in a step that is worth another

/// The point of the search: the registration, and each contour's shape in the modes of the reach.
struct Place {
  std::vector<double> v;
  std::vector<Vector> shapes;
};

/// Half the gradient and the Hessian of Gauss and Newton, in blocks: of v, of each shape, and of
/// both together.
struct Normal {
  Matrix4 a = Matrix4::Zero();
  Vector4 g = Vector4::Zero();
  std::vector<Matrix> h, b;
  std::vector<Vector> s;
};

/// Weights of a residual's square, and the scale of what is believed of shapes.
struct Weights {
  double trace, contour, strain;
};

Weights weights_of(const RegistrationProblem& p, const std::vector<double>& v) {
  const double lengths = std::exp(-2 * v[1]);
  size_t points = 0;
  for (const auto& contour : p.contours) points += contour.size();
  const double independent = double(std::min(p.trace.size(), most_trace));
  const auto frames = double(p.contours.size());
  return {
      lengths * independent / std::max<double>(1, double(p.trace.size())) / (palate_sd * palate_sd),
      lengths * p.weight / std::max<double>(1, double(points)) / (bent_sd * bent_sd),
      p.weight / contours_weight * std::min(1.0, shape_frames / frames)};
}

std::vector<Vec2> bent(const TongueReach& reach, const Vector& shape) {
  std::vector<Vec2> line = reach.rest;
  for (size_t i = 0; i < line.size(); ++i)
    for (Eigen::Index k = 0; k < shape.size(); ++k) line[i] += shape[k] * reach.modes[size_t(k)][i];
  return line;
}

/// How a residual turns with v. Distances count in the device's own lengths, else what fits badly
/// would shrink.
Rows4 by_v(const Vec2& at, const Vec2& middle, const Vec2& offset) {
  Rows4 rows = by_registration(at, middle);
  rows.col(1) -= offset;
  return rows;
}

/// What of a residual counts: across the line where the foot may slide along it, else all of it.
Eigen::Matrix2d counting(const std::vector<Vec2>& line, const LineFoot& foot) {
  const bool beyond =
      (foot.segment == 0 && foot.part <= 0) || (foot.segment + 2 == line.size() && foot.part >= 1);
  if (beyond) return Eigen::Matrix2d::Identity();
  const Vec2 along = line[foot.segment + 1] - line[foot.segment];
  const Vec2 across = Vec2(-along[1], along[0]).normalized();
  return across * across.transpose();
}

double cost_of(const RegistrationProblem& p, const TongueReach& reach, const Place& at) {
  const Similarity s = p.transform(at.v);
  const Weights w = weights_of(p, at.v);
  double sum = beliefs(p, at.v).cost;
  for (const Vec2& q : p.trace) sum += w.trace * foot_on(p.palate, s(q)).offset.squaredNorm();
  for (size_t k = 0; k < p.contours.size(); ++k) {
    const std::vector<Vec2> line = bent(reach, at.shapes[k]);
    for (const Vec2& q : p.contours[k]) sum += w.contour * foot_on(line, s(q)).offset.squaredNorm();
    sum += w.strain * at.shapes[k].squaredNorm();
  }
  return sum;
}

void add_trace(Normal& n, const RegistrationProblem& p, const Place& at, double weight) {
  const Similarity s = p.transform(at.v);
  for (const Vec2& q : p.trace) {
    const Vec2 moved = s(q);
    const LineFoot foot = foot_on(p.palate, moved);
    const Rows4 rows = by_v(moved, Vec2(at.v[2], at.v[3]), foot.offset);
    n.a += weight * rows.transpose() * counting(p.palate, foot) * rows;
    n.g += weight * rows.transpose() * foot.offset;
  }
}

void add_contour(Normal& n, size_t k, const RegistrationProblem& p, const TongueReach& reach,
                 const Place& at, double weight) {
  const Similarity s = p.transform(at.v);
  const std::vector<Vec2> line = bent(reach, at.shapes[k]);
  const auto modes = at.shapes[k].size();
  Eigen::Matrix<double, 2, Eigen::Dynamic> by_shape(2, modes);
  for (const Vec2& q : p.contours[k]) {
    const Vec2 moved = s(q);
    const LineFoot foot = foot_on(line, moved);
    for (Eigen::Index m = 0; m < modes; ++m) {
      const auto& mode = reach.modes[size_t(m)];
      by_shape.col(m) =
          -((1 - foot.part) * mode[foot.segment] + foot.part * mode[foot.segment + 1]);
    }
    const Rows4 rows = by_v(moved, Vec2(at.v[2], at.v[3]), foot.offset);
    const Eigen::Matrix2d counts = weight * counting(line, foot);
    n.a += rows.transpose() * counts * rows;
    n.g += weight * rows.transpose() * foot.offset;
    n.h[k] += by_shape.transpose() * counts * by_shape;
    n.b[k] += by_shape.transpose() * counts * rows;
    n.s[k] += weight * by_shape.transpose() * foot.offset;
  }
}

Normal normal_of(const RegistrationProblem& p, const TongueReach& reach, const Place& at) {
  const Weights w = weights_of(p, at.v);
  Normal n;
  const Beliefs known = beliefs(p, at.v);
  n.a = known.curvature, n.g = known.slope;
  add_trace(n, p, at, w.trace);
  for (size_t k = 0; k < p.contours.size(); ++k) {
    const auto modes = at.shapes[k].size();
    n.h.push_back(w.strain * Matrix::Identity(modes, modes));
    n.s.push_back(w.strain * at.shapes[k]);
    n.b.push_back(Matrix::Zero(modes, 4));
    add_contour(n, k, p, reach, at, w.contour);
  }
  return n;
}

/// The equations of v with the shapes eliminated, and the factors of the shapes' own.
struct Eliminated {
  Matrix4 a;
  Vector4 right;
  std::vector<Eigen::LLT<Matrix>> shapes;
};

Eliminated eliminated(const Normal& n, double damping) {
  Eliminated e{n.a, -n.g, {}};
  e.a.diagonal() *= 1 + damping;
  for (size_t k = 0; k < n.h.size(); ++k) {
    Matrix h = n.h[k];
    h.diagonal() *= 1 + damping;
    const auto& factor = e.shapes.emplace_back(h);
    if (h.rows() == 0) continue;
    e.a -= n.b[k].transpose() * factor.solve(n.b[k]);
    e.right += n.b[k].transpose() * factor.solve(n.s[k]);
  }
  return e;
}

Place stepped(const Normal& n, double damping, Place at) {
  const Eliminated e = eliminated(n, damping);
  const Vector4 step = e.a.ldlt().solve(e.right);
  Vector4::Map(at.v.data()) += step;
  for (size_t k = 0; k < n.h.size(); ++k)
    if (n.h[k].rows() > 0) at.shapes[k] -= e.shapes[k].solve(n.s[k] + n.b[k] * step);
  return at;
}

}  // namespace

BentFit fit_bent_lines(const RegistrationProblem& problem, const TongueReach& reach,
                       std::vector<double> v) {
  Place at{std::move(v), std::vector<Vector>(problem.contours.size(),
                                             Vector::Zero(Eigen::Index(reach.modes.size())))};
  double cost = cost_of(problem, reach, at), damping = 1e-2;
  for (int k = 0; k < most_steps && damping < 1e6; ++k) {
    problem.step();
    const Place next = stepped(normal_of(problem, reach, at), damping, at);
    const double there = cost_of(problem, reach, next);
    if (!(there < cost)) {
      damping *= 10;
      continue;
    }
    const double fall = cost - there;
    at = next, cost = there, damping = std::max(damping / 5, 1e-8);
    if (fall < enough) break;
  }
  BentFit fit{.cost = cost, .v = at.v};
  for (const Vector& shape : at.shapes) fit.lines.push_back(bent(reach, shape));
  fit.spread = eliminated(normal_of(problem, reach, at), 0).a.ldlt().solve(Matrix4::Identity());
  return fit;
}

}  // namespace genio
