// Patch tests and problems with exact answers: what a finite-element code must get right before
// anything built on it is believed.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "bench/problems/manufactured.hpp"
#include "bench/problems/problems.hpp"
#include "bench/problems/sphere.hpp"
#include "bench/problems/traction.hpp"
#include "forward/geometry/box_mesh.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio {
namespace {

constexpr double side = 0.03;

HexMesh distorted_cube() {
  HexMesh mesh = box_mesh(Vec3::Constant(side), {3, 3, 3});
  std::mt19937 bits(9);
  for (Vec3& x : mesh.nodes) {
    const Vec3 at = x;
    for (int i = 0; i < 3; ++i) {
      const double shake = 2.4e-3 * (2 * double(bits()) / 4294967296.0 - 1);
      if (at[i] > 1e-9 && at[i] < side - 1e-9) x[i] += shake;  // faces stay planes
    }
  }
  return mesh;
}

double farthest_from(const Model& m, const Positions& x, const Mat3& f) {
  double d = 0;
  for (size_t a = 0; a < m.mesh.nodes.size(); ++a)
    d = std::max(d, (node_position(x, int(a)) - f * m.mesh.nodes[a]).norm());
  return d;
}

class Patch : public testing::TestWithParam<double> {};  // Poisson's ratio

TEST_P(Patch, DisplacementDrivenDistortedHexahedraReproduceAffineMaps) {
  const TissueConstants c{192, 90, bench::bulk_modulus(192, GetParam())};
  HexMesh mesh = distorted_cube();
  std::vector<Support> supports;
  for (const Vec3& x : mesh.nodes)
    supports.push_back(x.minCoeff() > 1e-9 && x.maxCoeff() < side - 1e-9 ? Support::free
                                                                         : Support::fixed);
  const Model m = bench::tissue_problem(std::move(mesh), supports, c);
  Mat3 f;
  f << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, 0.1, -0.15, 1.0;
  f *= std::cbrt(1.001 / f.determinant());
  Positions start(m.rest.size());
  std::mt19937 bits(2);
  for (size_t a = 0; a < supports.size(); ++a) {
    Vec3 x = f * m.mesh.nodes[a];
    for (int i = 0; i < 3; ++i)
      if (supports[a] == Support::free) x[i] += 8e-4 * (2 * double(bits()) / 4294967296.0 - 1);
    start.segment<3>(Eigen::Index(3 * a)) = x;
  }
  Workspace ws(m);
  const auto e = solve_equilibrium(m, default_parameters(m), start, ws);
  ASSERT_TRUE(e) << e.message;
  EXPECT_LT(farthest_from(m, e.x, f), 1e-9);
}

/// A distorted cube on three rollers under the nominal stress that stretches it by `stretch`.
void expect_stretches(const Vec3& stretch, const TissueConstants& c, double tolerance) {
  HexMesh mesh = distorted_cube();
  std::vector<Support> supports;
  for (const Vec3& x : mesh.nodes)
    supports.push_back(held_along(x[0] < 1e-9, x[1] < 1e-9, x[2] < 1e-9));
  const Mat3 f = stretch.asDiagonal();
  const Mat3 stress = bench::first_piola(f, c);
  Forces load = Forces::Zero(Eigen::Index(3 * mesh.nodes.size()));
  for (int i = 0; i < 3; ++i)
    bench::add_traction(
        mesh, stress, [&](const Vec3& x) { return x[i] > side - 1e-9; }, load);
  const Model m = bench::tissue_problem(std::move(mesh), supports, c, load);
  Workspace ws(m);
  const auto e = solve_equilibrium(m, default_parameters(m), m.rest, ws);
  ASSERT_TRUE(e) << e.message;
  EXPECT_LT(farthest_from(m, e.x, f), tolerance);
}

TEST_P(Patch, TractionDrivenDistortedHexahedraReproduceStretches) {
  expect_stretches(Vec3(1.25, 0.895, 0.894), {192, 90, bench::bulk_modulus(192, GetParam())}, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Verification, Patch, testing::Values(0.3, 0.49, 0.4999));

/// Nominal stress of the incompressible law in a body free at its sides, against our law.
TEST(Yeoh, UniaxialAndEquibiaxialStressAreTheIncompressibleOnes) {
  const TissueConstants c{192, 90, 192e5};
  for (const double l : {0.7, 0.85, 1.3, 2.0}) {
    for (const bool biaxial : {false, true}) {
      // Treloar (1975), sections 5.3 and 4.7, with W' = a10 + 2 a20 (I - 3).
      const double invariant = biaxial ? 2 * l * l + std::pow(l, -4) : l * l + 2 / l;
      const double slope = c.a10 + 2 * c.a20 * (invariant - 3);
      const double exact = 2 * slope * (l - std::pow(l, biaxial ? -5 : -2));
      // The lateral stretch that frees the sides of our nearly incompressible law.
      double free = biaxial ? 1 / (l * l) : 1 / std::sqrt(l);
      const auto stress = [&](double s) {
        return bench::first_piola(Mat3((biaxial ? Vec3(l, l, s) : Vec3(l, s, s)).asDiagonal()), c);
      };
      for (int i = 0; i < 20; ++i) {
        const double h = 1e-7;
        free -= stress(free)(2, 2) * 2 * h / (stress(free + h)(2, 2) - stress(free - h)(2, 2));
      }
      EXPECT_NEAR(stress(free)(0, 0), exact, 2e-3 * std::abs(exact)) << l << biaxial;
      if (l == 1.3)  // and the elements find it; compressed, dead loads let it buckle
        expect_stretches(biaxial ? Vec3(l, l, free) : Vec3(l, free, free), c, 1e-8);
    }
  }
}

TEST(Yeoh, SimpleShearStressIsTheExactOne) {
  const TissueConstants c{192, 90, 192e4};
  for (const double shear : {0.2, 0.8, 1.6}) {
    HexMesh mesh = box_mesh(Vec3::Constant(side), {3, 3, 3});
    const std::vector<Support> supports(mesh.nodes.size(), Support::fixed);
    const Model m = bench::tissue_problem(std::move(mesh), supports, c);
    Mat3 f = Mat3::Identity();
    f(0, 2) = shear;
    Positions x(m.rest.size());
    double push = 0;  // along x on the upper face
    for (size_t a = 0; a < supports.size(); ++a)
      x.segment<3>(Eigen::Index(3 * a)) = f * m.mesh.nodes[a];
    const Forces forces = force(m, x, default_parameters(m));
    for (size_t a = 0; a < supports.size(); ++a)
      if (m.mesh.nodes[a][2] > side - 1e-9) push -= forces[Eigen::Index(3 * a)];
    // I - 3 = shear^2 and the shear stress is 2 W' shear (Holzapfel 2000, example 6.2).
    EXPECT_NEAR(push, 2 * (c.a10 + 2 * c.a20 * shear * shear) * shear * side * side, 1e-9 * push);
  }
}

TEST(Verification, BlownUpSphereHasTheExactPressure) {
  EXPECT_NEAR(bench::sphere_pressure_ratio(8, 6, 1.5), 1, 0.02);
}

TEST(Verification, CooksMembraneDoesNotLock) {
  for (const double nu : {0.3, 0.49, 0.499, 0.4999}) {
    const double coarse = bench::cook_corner(8, nu), fine = bench::cook_corner(24, nu);
    EXPECT_NEAR(coarse, fine, 0.04 * fine) << nu;
  }
}

TEST(Verification, ManufacturedSolutionConvergesWithSecondOrder) {
  for (const double nu : {0.3, 0.4999})
    for (const double distortion : {0.0, 0.1}) {
      const double coarse = bench::manufactured_error(5, nu, distortion),
                   fine = bench::manufactured_error(10, nu, distortion);
      EXPECT_GT(std::log2(coarse / fine), 1.9) << nu << " " << distortion;
    }
}

}  // namespace
}  // namespace genio
