#include "bench/problems/manufactured.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "bench/problems/problems.hpp"
#include "forward/geometry/box_mesh.hpp"
#include "forward/geometry/hex8.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio::bench {
namespace {

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

constexpr double cube_side = 0.05;  // of the manufactured cube [m]
constexpr double wave = std::numbers::pi / cube_side, swing = 0.1 * cube_side;

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
  const double h = 2e-3 * cube_side;
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

double manufactured_error(int n, double nu, double distortion) {
  HexMesh mesh = box_mesh(Vec3::Constant(cube_side), {n, n, n});
  std::vector<Support> supports;
  std::mt19937 bits(5);
  for (Vec3& x : mesh.nodes) {
    const bool inside = x.minCoeff() > 1e-9 && x.maxCoeff() < cube_side - 1e-9;
    supports.push_back(inside ? Support::free : Support::fixed);
    for (int i = 0; i < 3; ++i) {
      const double shake = 2 * double(bits()) / 4294967296.0 - 1;
      if (inside) x[i] += distortion * cube_side / n * shake;
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
  if (!e) return std::numeric_limits<double>::quiet_NaN();
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

}  // namespace genio::bench
