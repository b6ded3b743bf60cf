#include "inverse/target/comparison_curvature.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "forward/geometry/surfaces/closest_point.hpp"
#include "inverse/target/moved_target.hpp"

namespace genio {
namespace {

constexpr double no_distance = 1e-9;  // [m]

using Entries = std::vector<Eigen::Triplet<double>>;

/// One distance d over a few degrees of freedom: its derivatives, and where these stand in all.
struct Distance {
  double value;
  Vector first;
  Matrix second;
  std::vector<int> at;
};

/// What the loss of d / sigma bends beyond the square of its slope.
Matrix bend(const Distance& d, double sigma, double dof) {
  const SoftLoss loss(d.value / sigma, dof);
  return loss.loss_slope / sigma * d.second + (loss.loss_curvature - loss.slope * loss.slope) /
                                                  (sigma * sigma) * d.first * d.first.transpose();
}

void add(const Matrix& m, const std::vector<int>& at, Entries& entries) {
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      if (m(i, j) != 0) entries.emplace_back(at[size_t(i)], at[size_t(j)], m(i, j));
}

/// r with r^2 = across^2 + (part beyond)^2 and the sign of `across`.
Distance past_end(const Distance& across, const Distance& beyond, double part) {
  const double r = std::copysign(std::hypot(across.value, part * beyond.value), across.value);
  const double square = part * part;
  Distance d{
      r, (across.value * across.first + square * beyond.value * beyond.first) / r, {}, across.at};
  d.second = (across.first * across.first.transpose() + across.value * across.second +
              square * (beyond.first * beyond.first.transpose() + beyond.value * beyond.second) -
              d.first * d.first.transpose()) /
             r;
  return d;
}

/// The point slides along the line as either moves: with e = q - c = d n, e . c' = 0 gives dt, and
///   d_ij = -(D / s^2) (b_i t_j + t_i b_j) + (d / s^2) b_i b_j - (k D / s^2) t_i t_j + n . q_ij,
/// s = |c'|, k = n . c'', D = s^2 - d k, b = n . dc', t = dt.
Distance line_distance(const CurvePoint& point, const TongueLine& line, const Positions& x,
                       const MovedTarget& moved) {
  const Vec2 q = moved(point.position);
  const auto c = line.closest(x, q);
  const Vector w = line.weights(c.t), slope = line.weights(c.t, 1);
  const Eigen::Matrix2Xd control = line.control(x);
  const Vec2 along = control * slope;
  const double s = along.norm(), k = c.normal.dot(control * line.weights(c.t, 2));
  const double big = s * s - c.distance * k;
  const Vec2 tangent = along / s;
  const auto nodes = Eigen::Index(line.nodes().size());
  Vector a = Vector::Zero(2 * nodes + 3), b = a, first = a;
  std::vector<int> at(size_t(2 * nodes + 3));
  for (Eigen::Index i = 0; i < nodes; ++i) {
    a.segment<2>(2 * i) = -w[i] * tangent;
    b.segment<2>(2 * i) = slope[i] * c.normal;
    first.segment<2>(2 * i) = -w[i] * c.normal;
    at[size_t(2 * i)] = 3 * line.nodes()[size_t(i)];
    at[size_t(2 * i + 1)] = 3 * line.nodes()[size_t(i)] + 2;
  }
  const auto by_pose = moved.by_pose(q);
  a.tail<3>() = by_pose.transpose() * tangent;
  first.tail<3>() = by_pose.transpose() * c.normal;
  for (int i = 0; i < 3; ++i) at[size_t(2 * nodes + i)] = int(x.size()) + i;
  const Vector t = (s * a + c.distance * b) / big;
  const double over = 1 / (s * s);
  Matrix second = over * (-big * (b * t.transpose() + t * b.transpose()) +
                          c.distance * b * b.transpose() - k * big * t * t.transpose());
  second(2 * nodes + 2, 2 * nodes + 2) += c.normal.dot(moved.by_turn_twice(q));
  Distance across{c.distance, std::move(first), std::move(second), std::move(at)};
  const double past = point.past_end(c.beyond);
  if (past == 0) return across;
  // Past the end e tau, e from the end's node: the straight end turns by f = n . dc' / s, so that
  //   d_i = e_i . tau + (e . n) f_i,
  //   d_ij = (e_i . n) f_j + f_i (e_j . n) - (e . n) (f_i g_j + g_i f_j) - d f_i f_j + tau . q_ij,
  // g = tau . dc' / s.
  const Vector w_end = line.weights(std::clamp(c.t, 0.0, line.length()));
  Vector to_normal = Vector::Zero(2 * nodes + 3), to_tangent = to_normal, f = b / s, g = to_normal;
  for (Eigen::Index i = 0; i < nodes; ++i) {
    to_normal.segment<2>(2 * i) = -w_end[i] * c.normal;
    to_tangent.segment<2>(2 * i) = -w_end[i] * tangent;
    g.segment<2>(2 * i) = slope[i] / s * tangent;
  }
  to_normal.tail<3>() = by_pose.transpose() * c.normal;
  to_tangent.tail<3>() = by_pose.transpose() * tangent;
  Distance beyond{past, to_tangent + c.distance * f,
                  to_normal * f.transpose() + f * to_normal.transpose() -
                      c.distance * (f * g.transpose() + g * f.transpose()) -
                      c.beyond * f * f.transpose(),
                  across.at};
  beyond.second(2 * nodes + 2, 2 * nodes + 2) += tangent.dot(moved.by_turn_twice(q));
  return past_end(across, beyond, point.sigma / point.past_end_sigma());
}

/// From a distance over the corners of a facet to one over its nodes: its middle is their mean.
Distance over_nodes(const Distance& d, const Facet& facet) {
  Matrix corners = Matrix::Zero(12, 15);
  corners.block<6, 6>(0, 0).setIdentity(), corners.block<3, 3>(9, 12).setIdentity();
  for (int a = 0; a < 4; ++a) corners.block<3, 3>(6, 3 * a) = 0.25 * Mat3::Identity();
  Distance result{
      d.value, corners.transpose() * d.first, corners.transpose() * d.second * corners, {}};
  for (int node : facet)
    for (int i = 0; i < 3; ++i) result.at.push_back(3 * node + i);
  result.at.insert(result.at.end(), d.at.end() - 3, d.at.end());
  return result;
}

/// From a triangle, over its corners and the pose: within it to its plane; past an edge or a corner
/// to that, by
///   min over w of |q - f(w)|^2 / 2, whose second derivative is that of the function less
///   f_iw f_ww^-1 f_wj.
Distance triangle_distance(const SurfacePoint& point, const std::array<Vec3, 3>& p,
                           Eigen::Index size, const MovedTarget& moved) {
  const Vec3 q = moved(point.position);
  const auto w = closest_on_triangle(q, p[0], p[1], p[2]);
  const Vec3 foot = w[0] * p[0] + w[1] * p[1] + w[2] * p[2];
  const Vec3 area = (p[1] - p[0]).cross(p[2] - p[0]), face = area.normalized();
  const double off = (q - foot).norm();
  const double sign = (q - foot).dot(face) >= 0 ? 1 : -1;
  using Motion = Eigen::Matrix<double, 3, 12>;
  // Motion of q against the foot, were it to keep its weights.
  Motion m = Motion::Zero();
  Distance d{sign * off, Vector::Zero(12), Matrix::Zero(12, 12), std::vector<int>(12)};
  for (int l = 0; l < 3; ++l) m.block<3, 3>(0, 3 * l) = -w[size_t(l)] * Mat3::Identity();
  const Vec2 flat(q[0], q[2]), twice = moved.by_turn_twice(flat);
  const auto by_pose = moved.by_pose(flat);
  m.block<1, 3>(0, 9) = by_pose.row(0), m.block<1, 3>(2, 9) = by_pose.row(1);
  for (int i = 0; i < 3; ++i) d.at[size_t(9 + i)] = int(size) + i;
  const Vec3 turning(twice[0], 0, twice[1]);  // of q, second derivative

  if (w[0] > 0 && w[1] > 0 && w[2] > 0) {
    Mat3 g;  // gradients of the barycentric coordinates, columns
    for (int l = 0; l < 3; ++l)
      g.col(l) = face.cross(Vec3(p[size_t((l + 2) % 3)] - p[size_t((l + 1) % 3)])) / area.norm();
    Motion across = Motion::Zero();  // row l: n . motion of corner l
    for (int l = 0; l < 3; ++l) across.block<1, 3>(l, 3 * l) = face.transpose();
    const Motion slide = g.transpose() * m;
    d.first = m.transpose() * face;
    d.second = -across.transpose() * slide - slide.transpose() * across -
               d.value * across.transpose() * (g.transpose() * g) * across;
    d.second(11, 11) += face.dot(turning);
    return d;
  }
  if (off < no_distance) return d;
  const Vec3 e = q - foot;
  Matrix square = m.transpose() * m;
  square(11, 11) += e.dot(turning);
  for (int l = 0; l < 3; ++l) {  // an edge has two corners with weight: slide from one to the other
    const int from = l, to = (l + 1) % 3;
    if (!(w[size_t(from)] > 0 && w[size_t(to)] > 0)) continue;
    const Vec3 edge = p[size_t(to)] - p[size_t(from)];
    Vector by_slide = -m.transpose() * edge;
    by_slide.segment<3>(3 * to) -= e, by_slide.segment<3>(3 * from) += e;
    square -= by_slide * by_slide.transpose() / edge.squaredNorm();
  }
  const Vector slope = m.transpose() * e / off;
  d.first = sign * slope;
  d.second = sign / off * (square - slope * slope.transpose());
  return d;
}

}  // namespace

std::vector<Eigen::Triplet<double>> misfit_curvature(const Comparison& comparison,
                                                     const Positions& x, const HeadPose& pose,
                                                     const Residuals& residuals) {
  const Target& target = comparison.target();
  const MovedTarget moved(pose, comparison.middle());
  const double dof = target.outlier_dof;
  const int turn = int(x.size()) + 2;
  Entries entries;
  Matrix of_line;  // all points of the curve share its degrees of freedom
  std::vector<int> at;
  for (const auto& point : target.curve) {
    Distance d = line_distance(point, comparison.line(), x, moved);
    if (of_line.size() == 0) of_line.setZero(d.second.rows(), d.second.cols());
    of_line += bend(d, point.sigma, dof);
    at = std::move(d.at);
  }
  add(of_line, at, entries);
  size_t row = target.curve.size();
  for (const auto& point : target.flesh) {
    const Vec3 q = moved(point.position), off = point.on(x) - q;
    const Vec2 flat(q[0], q[2]), twice = moved.by_turn_twice(flat);
    for (int i = 0; i < 3; ++i) {
      if (std::isnan(off[i])) continue;
      ++row;
      const size_t count = point.at.size();
      Distance d{off[i],
                 Vector(count + 3),
                 Matrix::Zero(Eigen::Index(count + 3), Eigen::Index(count + 3)),
                 {}};
      for (size_t k = 0; k < count; ++k) {
        d.first[Eigen::Index(k)] = point.at[k].second;
        d.at.push_back(3 * point.at[k].first + i);
      }
      for (int k = 0; k < 3; ++k) d.at.push_back(turn - 2 + k);
      d.first.tail<3>().setZero();
      if (i != 1) {
        d.first.tail<3>() = -moved.by_pose(flat).row(i / 2).transpose();
        d.second(Eigen::Index(count + 2), Eigen::Index(count + 2)) = -twice[i / 2];
      }
      add(bend(d, point.sigma, dof), d.at, entries);
    }
  }
  for (const auto& point : target.surface) {
    const auto& nodes = residuals.gradient[row++];
    const Facet facet{nodes[0].first, nodes[1].first, nodes[2].first, nodes[3].first};
    const Distance d =
        over_nodes(triangle_distance(point, corners_of(facet, x), x.size(), moved), facet);
    add(bend(d, point.sigma, dof), d.at, entries);
  }
  return entries;
}

}  // namespace genio
