#include "inverse/recording/registration/reach.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/model/mirror.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio {
namespace {

constexpr int line_points = 60;
constexpr double usual_part = 0.2;  // of a muscle's maximum
constexpr double settled = 1e-4;    // of a residual: modes are of other postures anyway
// No muscle moves the line farther in a usual posture [m], root mean square: recordings of speech
// lie so far from their mean.
constexpr double posture_sd = 5e-3;
constexpr Eigen::Index most_modes = 6;

/// Names of the model's muscles, left and right as one.
std::vector<std::string> muscle_names(const Model& model) {
  std::vector<std::string> names;
  for (const auto& muscle : model.muscles)
    if (const std::string name = bilateral_name(muscle.name);
        std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names;
}

double greatest_force(const Model& model, const std::string& name) {
  double sum = 0;
  for (int k : command_parameters(model, name)) sum += model.parameters[size_t(k)].info.upper;
  return sum;
}

/// Displacements of the line, a column a muscle that acts alone; empty where the model does not
/// rest in equilibrium. A derivative at rest would overstate them tenfold, for tissue stiffens.
Matrix moves(const Model& model, const TongueLine& line) {
  const auto mirror = mirror_of(model);
  const Model& solved = mirror ? mirror->half : model;
  Workspace ws(solved);
  const Parameters passive = default_parameters(solved);
  const Equilibrium rest = solve_equilibrium(solved, passive, solved.rest, ws);
  if (!rest) return {};
  const auto sampled = [&](const Positions& x) {
    return line.sample(mirror ? Positions(mirror->whole(x)) : x, line_points);
  };
  const auto from = sampled(rest.x);
  Matrix result(2 * line_points, 0);
  for (const std::string& name : muscle_names(solved)) {
    Parameters p = passive;
    set_command(solved, name, usual_part * greatest_force(solved, name), p);
    const Equilibrium pulled = solve_equilibrium(solved, p, rest.x, ws, {.tolerance = settled});
    if (!pulled) continue;
    const auto moved = sampled(pulled.x);
    Vector move(2 * line_points);
    for (int i = 0; i < line_points; ++i)
      move.segment<2>(2 * i) = moved[size_t(i)] - from[size_t(i)];
    move /= std::max(1.0, move.norm() / (posture_sd * std::sqrt(double(line_points))));
    result.conservativeResize(Eigen::NoChange, result.cols() + 1);
    result.col(result.cols() - 1) = move;
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

}  // namespace genio
