#include "bench/problems/sphere.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "bench/problems/problems.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio::bench {
namespace {

constexpr double inner = 0.01, outer = 0.02;  // radii at rest [m]

/// Six patches of n x n x layers elements, as a cube blown up to a sphere.
HexMesh sphere_mesh(int n, int layers) {
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
  return mesh;
}

/// Pressure that holds the inner surface at `radius`, where r^3 - R^3 = more [m^3] everywhere; by
/// the midpoint rule [Pa].
double exact_pressure(const TissueConstants& c, double radius, double more) {
  // Balance: d sigma_r/dr = 2 (sigma_t - sigma_r)/r,
  // sigma_t - sigma_r = 2 W' (l^2 - l^-4), l = r/R.
  double exact = 0;
  const int steps = 2000;
  const double end = std::cbrt(outer * outer * outer + more), dr = (end - radius) / steps;
  for (int i = 0; i < steps; ++i) {
    const double r = radius + (i + 0.5) * dr, l = r / std::cbrt(r * r * r - more);
    const double invariant = 2 * l * l + std::pow(l, -4);
    exact += dr * 4 / r * (c.a10 + 2 * c.a20 * (invariant - 3)) * (l * l - std::pow(l, -4));
  }
  return exact;
}

}  // namespace

double sphere_pressure_ratio(int n, int layers, double stretch) {
  HexMesh mesh = sphere_mesh(n, layers);
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
  if (!e) return std::numeric_limits<double>::quiet_NaN();
  const Forces f = force(m, e.x, e.parameters);
  double push = 0;  // the tissue's on the inner surface
  for (size_t a = 0; a < m.supports.size(); ++a)
    if (m.supports[a] == Support::fixed)
      push -= node_position(f, int(a)).dot(node_position(e.x, int(a)).normalized());
  const double radius = inner * stretch;
  const double pressure = push / (4 * std::numbers::pi * radius * radius);
  return pressure / exact_pressure(c, radius, more);
}

}  // namespace genio::bench
