// The linear framework beside the equilibrium that it comes near to for small forces.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/problems/problems.hpp"
#include "bench/problems/traction.hpp"
#include "forward/geometry/box_mesh.hpp"
#include "forward/statics/equilibrium.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

Model weightless_block() {
  ModelDescription d = test::small_block();
  d.effects.erase("gravity");
  return build_model(d, "block");
}

/// Displacements by small deformation under these forces of the two muscles [N].
Vector small_displacement(const Model& m, double first, double second, Workspace& ws) {
  Parameters p = default_parameters(m);
  set_command(m, "GGP_L", first, p);
  set_command(m, "GGP_R", second, p);
  const Equilibrium e = solve_small_deformation(m, p, ws);
  EXPECT_TRUE(e) << e.message;
  return e.x - m.rest;
}

TEST(SmallDeformation, IsProportionalToTheForce) {
  const Model m = weightless_block();
  Workspace ws(m);
  const Vector one = small_displacement(m, 0.02, 0, ws);
  ASSERT_GT(one.norm(), 0);
  for (const double times : {0.01, 3.0, 50.0})
    EXPECT_LT((small_displacement(m, 0.02 * times, 0, ws) - times * one).norm(),
              1e-11 * times * one.norm())
        << times;
}

TEST(SmallDeformation, AddsUpOverMusclesAndWeight) {
  const Model heavy = test::small_model(), weightless = weightless_block();
  Workspace of_heavy(heavy), of_weightless(weightless);
  const Vector weight = small_displacement(heavy, 0, 0, of_heavy);
  ASSERT_GT(weight.norm(), 0);
  const Vector sum = weight + small_displacement(weightless, 0.3, 0, of_weightless) +
                     small_displacement(weightless, 0, 0.2, of_weightless);
  EXPECT_LT((small_displacement(heavy, 0.3, 0.2, of_heavy) - sum).norm(), 1e-9 * sum.norm());
}

TEST(SmallDeformation, HalvingTheForceQuartersTheDifferenceFromTheEquilibrium) {
  for (const bool generic : {false, true}) {
    const Model m = generic ? read_model(test::generic_model()) : weightless_block();
    Workspace ws(m);
    SolveOptions tight;
    tight.tolerance = 1e-12;
    double before = 0;
    for (double force = generic ? 0.2 : 4e-3; before == 0 || force > (generic ? 0.01 : 2e-4);
         force /= 2) {
      Parameters p = default_parameters(m);
      set_command(m, "GGP", force, p);
      const Equilibrium large = solve_equilibrium(m, p, m.rest, ws, tight);
      ASSERT_TRUE(large) << large.message;
      const Equilibrium small = solve_small_deformation(m, p, ws);
      ASSERT_TRUE(small) << small.message;
      const double difference = (large.x - small.x).norm();
      if (before > 0) {
        EXPECT_NEAR(std::log2(before / difference), 2, 0.1) << m.name << " " << force << " N";
      }
      before = difference;
    }
  }
}

/// A cube on three rollers under a uniform stress, its inner nodes shaken, answers by Hooke's law.
TEST(SmallDeformation, OfAUniformStressIsHookesStrainOnDistortedHexahedra) {
  constexpr double side = 0.03;
  const Vec3 strain(0.11, -0.04, -0.05);
  for (const double poisson_ratio : {0.3, 0.49, 0.4999}) {
    const double shear = 2 * 192, bulk = bench::bulk_modulus(192, poisson_ratio);
    HexMesh mesh = box_mesh(Vec3::Constant(side), {3, 3, 3});
    std::vector<Support> supports;
    for (Vec3& x : mesh.nodes) {
      supports.push_back(held_along(x[0] < 1e-9, x[1] < 1e-9, x[2] < 1e-9));
      if (x.minCoeff() > 1e-9 && x.maxCoeff() < side - 1e-9)
        x += 0.1 * Vec3(x[1] - 0.4 * side, 0.5 * side - x[2], x[0] - 0.7 * side);
    }
    const Vec3 deviator = strain - Vec3::Constant(strain.sum() / 3);
    const Mat3 stress = (2 * shear * deviator + Vec3::Constant(bulk * strain.sum())).asDiagonal();
    Forces load = Forces::Zero(Eigen::Index(3 * mesh.nodes.size()));
    for (int i = 0; i < 3; ++i)
      bench::add_traction(
          mesh, stress, [&](const Vec3& x) { return x[i] > side - 1e-9; }, load);
    const Model m = bench::tissue_problem(std::move(mesh), supports, {192, 90, bulk}, load);
    Workspace ws(m);
    const Equilibrium e = solve_small_deformation(m, default_parameters(m), ws);
    ASSERT_TRUE(e) << e.message;
    for (size_t a = 0; a < m.mesh.nodes.size(); ++a) {
      const Vec3 u = node_position(e.x, int(a)) - m.mesh.nodes[a];
      EXPECT_LT((u - strain.cwiseProduct(m.mesh.nodes[a])).norm(), 1e-10) << poisson_ratio;
    }
  }
}

TEST(SmallDeformation, FailureIsAStatusWithAReason) {
  const Model m = test::small_model();
  for (const char* name : {"muscles.GGP_L", "elasticity.a10"}) {
    Parameters p = default_parameters(m);
    p[parameter_index(m, name)] = std::numeric_limits<double>::quiet_NaN();
    Workspace ws(m);
    const Equilibrium e = solve_small_deformation(m, p, ws);
    EXPECT_FALSE(e) << name;
    EXPECT_FALSE(e.message.empty());
  }
}

}  // namespace
}  // namespace genio
