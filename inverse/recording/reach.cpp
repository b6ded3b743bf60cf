#include "inverse/recording/reach.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "forward/statics/sensitivity.hpp"

namespace genio {
namespace {

constexpr int line_points = 60;
constexpr double usual_part = 0.2;  // of a muscle's maximum
constexpr Eigen::Index most_modes = 6;
constexpr int rounds = 4;

/// Displacements of the line, a column a muscle at its usual force; empty where the model does not
/// rest in a stable equilibrium.
Matrix moves(const Model& model, const TongueLine& line) {
  Workspace ws(model);
  const Equilibrium rest = solve_equilibrium(model, default_parameters(model), model.rest, ws);
  std::vector<int> commands;
  for (size_t k = 0; k < model.parameters.size(); ++k)
    if (model.parameters[k].is_command) commands.push_back(int(k));
  if (!rest || commands.empty()) return {};
  const Matrix by_force = sensitivity(model, rest, commands, ws);
  Matrix result(by_force.size() > 0 ? 2 * line_points : 0, by_force.cols());
  for (Eigen::Index c = 0; c < by_force.cols() && result.rows() > 0; ++c) {
    const double force = usual_part * model.parameters[size_t(commands[size_t(c)])].info.upper;
    const auto moved = line.sample(Positions(rest.x + force * by_force.col(c)), line_points);
    const auto from = line.sample(rest.x, line_points);
    for (int i = 0; i < line_points; ++i)
      result.block<2, 1>(2 * i, c) = moved[size_t(i)] - from[size_t(i)];
  }
  return result;
}

}  // namespace

TongueReach reach_of(const Model& model) {
  const TongueLine line(model);
  TongueReach reach{line.sample(model.rest, line_points), {}};
  const Matrix all = moves(model, line);
  if (all.size() == 0) return reach;
  // Principal axes of the line's covariance under independent muscles.
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(all.transpose() * all);
  const auto n = all.cols();
  for (Eigen::Index k = 0; k < std::min(n, most_modes); ++k) {
    const Vector mode = all * eigen.eigenvectors().col(n - 1 - k);
    auto& points = reach.modes.emplace_back();
    for (int i = 0; i < line_points; ++i) points.emplace_back(mode.segment<2>(2 * i));
  }
  return reach;
}

LineFoot foot_on(const std::vector<Vec2>& line, const Vec2& q) {
  double best = std::numeric_limits<double>::infinity();
  LineFoot result{0, 0, Vec2::Zero()};
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 d = line[i + 1] - line[i];
    const double t = std::clamp((q - line[i]).dot(d) / std::max(d.squaredNorm(), 1e-30), 0.0, 1.0);
    const Vec2 off = q - line[i] - t * d;
    if (off.squaredNorm() < best) best = off.squaredNorm(), result = {i, t, off};
  }
  return result;
}

ReachLine line_near(const TongueReach& reach, const std::vector<Vec2>& points, double sd) {
  const auto n = Eigen::Index(reach.modes.size());
  ReachLine line{reach.rest, 0};
  Vector a = Vector::Zero(n);
  for (int round = 0; round < rounds && n > 0; ++round) {
    Matrix precision = Matrix::Identity(n, n);
    Vector right = Vector::Zero(n);
    for (const Vec2& q : points) {
      const LineFoot foot = foot_on(line.points, q);
      const Vec2 along = line.points[foot.segment + 1] - line.points[foot.segment];
      const Vec2 normal = Vec2(-along[1], along[0]).normalized();
      Vector row(n);
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto& mode = reach.modes[size_t(k)];
        row[k] =
            normal.dot((1 - foot.part) * mode[foot.segment] + foot.part * mode[foot.segment + 1]);
      }
      precision += row * row.transpose() / (sd * sd);
      right += row * (normal.dot(foot.offset) + row.dot(a)) / (sd * sd);
    }
    a = precision.llt().solve(right);
    for (size_t i = 0; i < line.points.size(); ++i) {
      line.points[i] = reach.rest[i];
      for (Eigen::Index k = 0; k < n; ++k) line.points[i] += a[k] * reach.modes[size_t(k)][i];
    }
  }
  line.strain = a.squaredNorm();
  return line;
}

}  // namespace genio
