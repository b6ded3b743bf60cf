#include "bench/problems/problems.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "bench/problems/traction.hpp"
#include "forward/effects/surroundings/dead_load.hpp"
#include "forward/effects/tissue/viscosity.hpp"
#include "forward/geometry/box_mesh.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio::bench {
namespace {

constexpr double not_solved = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Model tissue_problem(HexMesh mesh, std::vector<Support> supports, const TissueConstants& constants,
                     Forces weights, double force) {
  ModelParts m;
  m.name = "verification";
  m.mesh = std::move(mesh);
  m.supports = std::move(supports);
  m.tissue_mass = tissue_mass(m.mesh, 1040);
  m.effects.push_back(elastic_tissue(m.mesh, constants));
  if (weights.size() > 0)
    m.effects.push_back(
        {.potential = std::make_shared<DeadLoad>("load", std::move(weights), force)});
  return Model(std::move(m));
}

Model damped(const Model& undamped, double alpha, double beta) {
  const auto constants = effect_parameters(undamped, default_parameters(undamped), 0);
  ModelParts m = undamped.parts();
  m.effects[0] = elastic_tissue(m.mesh, {constants[0], constants[1], constants[2]}, true);
  m.effects.push_back({.dissipation = std::make_shared<Viscosity>(m.tissue_mass, alpha, beta)});
  return Model(std::move(m));
}

Mat3 first_piola(const Mat3& f, const TissueConstants& c) {
  const double j = f.determinant(), j23 = std::pow(j, -2.0 / 3), i = j23 * f.squaredNorm();
  const Mat3 inverse_t = f.inverse().transpose();
  const double slope = c.a10 + 2 * c.a20 * (i - 3);
  return 2 * slope * (j23 * f - i / 3 * inverse_t) + c.kappa * (j - 1) * j * inverse_t;
}

double bulk_modulus(double a10, double nu) { return 4 * a10 * (1 + nu) / (3 * (1 - 2 * nu)); }

double cook_corner(int n, double nu) {
  HexMesh mesh = box_mesh(Vec3(0.048, 1e-3, 1), {n, 1, n});
  std::vector<Support> supports;
  for (Vec3& x : mesh.nodes) {
    const double s = x[0] / 0.048;
    supports.push_back(s < 1e-9 ? Support::fixed : held_along(false, true, false));
    const double low = 0.044 * s, high = 0.044 + 0.016 * s;
    x[2] = low + x[2] * (high - low);
  }
  Mat3 shear = Mat3::Zero();
  shear(2, 0) = 62.5;
  Forces load = Forces::Zero(Eigen::Index(3 * mesh.nodes.size()));
  add_traction(
      mesh, shear, [](const Vec3& x) { return x[0] > 0.048 - 1e-9; }, load);
  const double a10 = 0.5 * 801.938;
  const Model m =
      tissue_problem(std::move(mesh), std::move(supports), {a10, 0, bulk_modulus(a10, nu)}, load);
  Workspace ws(m);
  const Equilibrium e = solve_equilibrium(m, default_parameters(m), m.rest, ws);
  if (!e) return not_solved;
  const Eigen::Index corner = Eigen::Index(m.mesh.nodes.size()) - 1;
  return e.x[3 * corner + 2] - m.rest[3 * corner + 2];
}

}  // namespace genio::bench
