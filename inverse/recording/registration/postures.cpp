#include "inverse/recording/registration/postures.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "forward/model/mirror.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio {
namespace {

constexpr double usual_part = 0.2;  // of a muscle's maximum
constexpr double settled = 1e-4;    // of a residual: modes are of other postures anyway
// No muscle moves the tongue farther in a usual posture [m], root mean square: recordings of speech
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

}  // namespace

Postures postures_of(const Model& model, const std::function<void()>& on_step) {
  const auto mirror = mirror_of(model);
  const Model& solved = mirror ? mirror->half : model;
  const auto whole = [&](const Positions& x) { return mirror ? Positions(mirror->whole(x)) : x; };
  Workspace ws(solved);
  const Parameters passive = default_parameters(solved);
  if (on_step) on_step();
  const Equilibrium rest = solve_equilibrium(solved, passive, solved.rest, ws);
  if (!rest) return {};
  Postures postures{whole(rest.x), {}};
  for (const std::string& name : muscle_names(solved)) {
    if (on_step) on_step();
    Parameters p = passive;
    set_command(solved, name, usual_part * greatest_force(solved, name), p);
    const Equilibrium pulled = solve_equilibrium(solved, p, rest.x, ws, {.tolerance = settled});
    if (pulled) postures.pulled.push_back(whole(pulled.x));
  }
  return postures;
}

// A derivative at rest would overstate the modes tenfold, for tissue stiffens.
Matrix principal_modes(const Postures& postures, int dimension, const ShapeView& view) {
  if (postures.pulled.empty()) return {};
  const Vector from = view(postures.rest);
  const double points = double(from.size()) / dimension;
  Matrix moves(from.size(), Eigen::Index(postures.pulled.size()));
  for (Eigen::Index k = 0; k < moves.cols(); ++k) {
    const Vector move = view(postures.pulled[size_t(k)]) - from;
    moves.col(k) = move / std::max(1.0, move.norm() / (posture_sd * std::sqrt(points)));
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(moves.transpose() * moves);
  const Eigen::Index kept = std::min(moves.cols(), most_modes);
  return moves * eigen.eigenvectors().rightCols(kept).rowwise().reverse();
}

}  // namespace genio
