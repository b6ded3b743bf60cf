#include "bench/problems/problems.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "forward/effects/surroundings/dead_load.hpp"
#include "forward/effects/tissue/viscosity.hpp"
#include "forward/geometry/box_mesh.hpp"
#include "forward/geometry/hex8.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio::bench {
namespace {

constexpr double not_solved = std::numeric_limits<double>::quiet_NaN();

/// 3 x 3 x 3 Gauss points and weights on [-1, 1]^3.
template <class Act>
void each_point(Act act) {
  const double at[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)};
  const double weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) act(Vec3(at[i], at[j], at[k]), weight[i] * weight[j] * weight[k]);
}

/// act(element, place, weight [m^3], shape function values) over a mesh.
template <class Act>
void integrate(const HexMesh& mesh, Act act) {
  for (const auto& e : mesh.elements)
    each_point([&](const Vec3& xi, double w) {
      const auto n = hex8::values(xi);
      const auto corner = [&](int a) -> const Vec3& { return mesh.nodes[size_t(e[size_t(a)])]; };
      Vec3 x = Vec3::Zero();
      for (int a = 0; a < 8; ++a) x += n[size_t(a)] * corner(a);
      act(e, x, w * hex8::jacobian(corner, hex8::derivatives(xi)).determinant(), n);
    });
}

constexpr double side = 0.05;  // of the manufactured cube [m]
constexpr double wave = std::numbers::pi / side, swing = 0.1 * side;

/// Two shears one after the other: volume is kept exactly.
Vec3 manufactured(const Vec3& x) {
  const double moved = x[0] + swing * std::sin(wave * x[1]) * std::sin(wave * x[2]);
  return {moved, x[1], x[2] + swing * std::sin(wave * moved) * std::cos(wave * x[1])};
}

Mat3 manufactured_gradient(const Vec3& x) {
  const Vec3 s = (wave * x).array().sin(), c = (wave * x).array().cos();
  const double moved = wave * (x[0] + swing * s[1] * s[2]), a = swing * wave;
  Mat3 first = Mat3::Identity(), second = Mat3::Identity();
  first(0, 1) = a * c[1] * s[2], first(0, 2) = a * s[1] * c[2];
  second(2, 0) = a * std::cos(moved) * c[1], second(2, 1) = -a * std::sin(moved) * s[1];
  return second * first;
}

/// -Div P by differences of fourth order [N/m^3].
Vec3 manufactured_load(const Vec3& x, const TissueConstants& c) {
  const double h = 2e-3 * side;
  Vec3 load = Vec3::Zero();
  for (int j = 0; j < 3; ++j) {
    const auto stress = [&](double s) {
      Vec3 at = x;
      at[j] += s * h;
      return Vec3(first_piola(manufactured_gradient(at), c).col(j));
    };
    load -= (8 * (stress(1) - stress(-1)) - (stress(2) - stress(-2))) / (12 * h);
  }
  return load;
}

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

double manufactured_error(int n, double nu, double distortion) {
  HexMesh mesh = box_mesh(Vec3::Constant(side), {n, n, n});
  std::vector<Support> supports;
  std::mt19937 bits(5);
  for (Vec3& x : mesh.nodes) {
    const bool inside = x.minCoeff() > 1e-9 && x.maxCoeff() < side - 1e-9;
    supports.push_back(inside ? Support::free : Support::fixed);
    for (int i = 0; i < 3; ++i) {
      const double shake = 2 * double(bits()) / 4294967296.0 - 1;
      if (inside) x[i] += distortion * side / n * shake;
    }
  }
  const TissueConstants c{192, 90, bulk_modulus(192, nu)};
  Forces load = Forces::Zero(Eigen::Index(3 * mesh.nodes.size()));
  integrate(mesh, [&](const auto& e, const Vec3& x, double w, const auto& value) {
    const Vec3 f = w * manufactured_load(x, c);
    for (size_t a = 0; a < 8; ++a) load.segment<3>(3 * e[a]) += value[a] * f;
  });
  const Model m = tissue_problem(std::move(mesh), std::move(supports), c, load);
  Workspace ws(m);
  Positions start = m.rest;
  for (size_t a = 0; a < m.supports.size(); ++a)
    start.segment<3>(Eigen::Index(3 * a)) = manufactured(m.mesh.nodes[a]);
  const Equilibrium e = solve_equilibrium(m, default_parameters(m), start, ws);
  if (!e) return not_solved;
  double error = 0, whole = 0;
  integrate(m.mesh, [&](const auto& element, const Vec3& x, double w, const auto& value) {
    Vec3 u = Vec3::Zero();
    for (size_t a = 0; a < 8; ++a)
      u += value[a] * (node_position(e.x, element[a]) - node_position(m.rest, element[a]));
    const Vec3 exact = manufactured(x) - x;
    error += w * (u - exact).squaredNorm();
    whole += w * exact.squaredNorm();
  });
  return std::sqrt(error / whole);
}

double sphere_pressure_ratio(int n, int layers, double stretch) {
  constexpr double inner = 0.01, outer = 0.02;
  HexMesh mesh;
  std::map<std::array<long, 3>, int> known;  // nodes by place: patches share their rims
  const auto node = [&](const Vec3& x) {
    const std::array<long, 3> key = {std::lround(1e8 * x[0]), std::lround(1e8 * x[1]),
                                     std::lround(1e8 * x[2])};
    const auto [it, added] = known.emplace(key, int(mesh.nodes.size()));
    if (added) mesh.nodes.push_back(x);
    return it->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int sign : {-1, 1}) {
      const auto place = [&](int i, int j, int k) {
        const double u = std::tan(std::numbers::pi / 4 * (2.0 * i / n - 1)),
                     v = std::tan(std::numbers::pi / 4 * (2.0 * j / n - 1));
        Vec3 d;
        d[axis] = sign, d[(axis + 1) % 3] = sign * u, d[(axis + 2) % 3] = v;
        return Vec3((inner + (outer - inner) * k / layers) * d.normalized());
      };
      for (int k = 0; k < layers; ++k)
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
            mesh.elements.push_back(
                {node(place(i, j, k)), node(place(i + 1, j, k)), node(place(i + 1, j + 1, k)),
                 node(place(i, j + 1, k)), node(place(i, j, k + 1)), node(place(i + 1, j, k + 1)),
                 node(place(i + 1, j + 1, k + 1)), node(place(i, j + 1, k + 1))});
    }
  std::vector<Support> supports;
  for (const Vec3& x : mesh.nodes)
    supports.push_back(x.norm() < 1.001 * inner ? Support::fixed : Support::free);
  const TissueConstants c{192, 90, 192e4};
  const Model m = tissue_problem(std::move(mesh), std::move(supports), c);
  Workspace ws(m);
  const double more = inner * inner * inner * (stretch * stretch * stretch - 1);
  Positions x = m.rest;  // every radius as incompressibility has it
  for (Eigen::Index a = 0; a < x.size() / 3; ++a) {
    const double radius = x.segment<3>(3 * a).norm();
    x.segment<3>(3 * a) *= std::cbrt(radius * radius * radius + more) / radius;
  }
  const Equilibrium e = solve_equilibrium(m, default_parameters(m), x, ws);
  if (!e) return not_solved;
  const Forces f = force(m, e.x, e.parameters);
  double push = 0;  // the tissue's on the inner surface
  for (size_t a = 0; a < m.supports.size(); ++a)
    if (m.supports[a] == Support::fixed)
      push -= node_position(f, int(a)).dot(node_position(e.x, int(a)).normalized());
  const double radius = inner * stretch;
  const double pressure = push / (4 * std::numbers::pi * radius * radius);
  // Balance: d sigma_r/dr = 2 (sigma_t - sigma_r)/r, sigma_t - sigma_r = 2 W' (l^2 - l^-4), l =
  // r/R.
  double exact = 0;
  const int steps = 2000;
  const double end = std::cbrt(outer * outer * outer + more), dr = (end - radius) / steps;
  for (int i = 0; i < steps; ++i) {
    const double r = radius + (i + 0.5) * dr, l = r / std::cbrt(r * r * r - more);
    const double invariant = 2 * l * l + std::pow(l, -4);
    exact += dr * 4 / r * (c.a10 + 2 * c.a20 * (invariant - 3)) * (l * l - std::pow(l, -4));
  }
  return pressure / exact;
}

}  // namespace genio::bench
