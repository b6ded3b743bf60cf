#include "forward/effects/surroundings/contact.hpp"

#include <gtest/gtest.h>

#include <random>

#include "forward/geometry/surfaces/bone_distance.hpp"
#include "forward/geometry/surfaces/distance_field.hpp"
#include "forward/model/build_model.hpp"
#include "forward/statics/equilibrium.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

TriangleSurface octahedron(double r) {
  TriangleSurface s;
  s.vertices = {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
  s.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                 {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return s;
}

/// A square of the given half side in the plane z = 0, facing up.
TriangleSurface square(double half) {
  return {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}},
          {{0, 1, 2}, {0, 2, 3}}};
}

DistanceField field_of(const TriangleSurface& surface) {
  return {surface, Vec3::Constant(-0.02), Vec3::Constant(0.02), 2e-3};
}

TEST(SurfaceDistance, IsSignedAndExactAtFacesEdgesAndVertices) {
  const SurfaceDistance d(octahedron(1));
  EXPECT_NEAR(d({2, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(d({1, 1, 0}), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(d({1, 1, 1}), 2 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(d({0, 0, 0}), -1 / std::sqrt(3.0), 1e-12);
}

TEST(BoneDistance, BehindASheetTheBoneIsAsDeepAsItsRimIsFar) {
  const BoneDistance d(square(0.015));
  EXPECT_NEAR(d({0, 0, 0.003}), 0.003, 1e-12);
  EXPECT_NEAR(d({0, 0, -0.003}), -0.003, 1e-12);
  EXPECT_NEAR(d({0, 0, -0.009}), 0.001 * std::sqrt(0.5), 1e-12);  // 8 mm at most
  EXPECT_NEAR(d({0.013, 0, -0.003}), 0.001 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(d({0.016, 0, 0}), 0.001, 1e-12);  // beside the rim
  EXPECT_NEAR(d({0.016, 0, -0.001}), 0.001 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(d({0.0155, 0, -0.001}), 0.0015 * std::sqrt(0.5), 1e-12);
}

TEST(BoneDistance, JumpsNowhereAboutTheRimOfASheet) {
  const BoneDistance d(square(0.015));
  std::mt19937 bits(5);
  const auto uniform = [&] { return 0.02 * (2 * double(bits()) / 4294967296.0 - 1); };
  for (int k = 0; k < 20000; ++k) {
    const Vec3 p(uniform(), uniform(), 0.5 * uniform());
    const Vec3 q = p + 1e-3 * Vec3(uniform(), uniform(), uniform());
    EXPECT_LE(std::abs(d(p) - d(q)), 1.5 * (p - q).norm());
  }
}

TEST(DistanceField, GradientAndHessianAreItsDerivatives) {
  const DistanceField f = field_of(octahedron(0.01));
  const Vec3 p(0.0061, 0.0043, 0.0004);  // near an edge, where it bends
  const auto s = f.sample(p);
  EXPECT_EQ(s.value, f.value(p));
  for (int i = 0; i < 3; ++i) {
    const Vec3 h = 1e-7 * Vec3::Unit(i);
    EXPECT_NEAR((f.value(p + h) - f.value(p - h)) / 2e-7, s.gradient[i], 1e-7);
    const Vec3 slope = (f.sample(p + h).gradient - f.sample(p - h).gradient) / 2e-7;
    EXPECT_LE((slope - s.hessian.col(i)).norm(), 1e-4 * s.hessian.norm());
  }
}

TEST(DistanceField, LeavesFacesWhereTheyAreAndRoundsEdgesByATenthOfAMillimetre) {
  const DistanceField f = field_of(octahedron(0.01));
  EXPECT_NEAR(f.value({0.0033, 0.0033, 0.0034}), 0, 1e-6);
  EXPECT_NEAR(f.value({0.005, 0.005, 0}), 0, 1e-4);
}

TEST(DistanceField, BoundsAreBelowItsValuesBeforeAndAfterTheFineGridIsThere) {
  const DistanceField f = field_of(octahedron(0.01));
  std::mt19937 bits(7);
  const auto uniform = [&] { return 0.016 * (2 * double(bits()) / 4294967296.0 - 1); };
  for (int k = 0; k < 4000; ++k) {
    const Vec3 p(uniform(), uniform(), uniform());
    const double radius = 1e-3, before = f.at_least(p, radius);
    const double value = f.value(p + 0.9e-3 * Vec3(uniform(), uniform(), uniform()).normalized());
    EXPECT_LE(before, value);
    EXPECT_LE(f.at_least(p, radius), value);
    const double touching = f.value_if_touching(p);
    if (f.value(p) < 2e-4) EXPECT_EQ(touching, f.value(p));
    else EXPECT_GE(touching, 2e-4);
  }
}

/// A block that gravity pulls up against the palate of `d`.
Equilibrium pulled_up(const ModelDescription& d, const Model& m, Workspace& ws) {
  EXPECT_TRUE(d.effects.contains("palate_contact"));
  return solve_equilibrium(m, default_parameters(m), m.rest, ws);
}

ModelDescription block_that_falls_upwards() {
  auto d = test::small_block();
  d.effects["elasticity"]["kappa"] = 192000;
  d.effects["palate_contact"]["stiffness"] = 2e8;
  d.effects["gravity"] = {{"x", 0}, {"y", 0}, {"z", 19}};
  return d;
}

TEST(Contact, HoldsTheBlockBelowThePalate) {
  const auto d = block_that_falls_upwards();
  const Model m = build_model(d, "block");
  Workspace ws(m);
  const auto e = pulled_up(d, m, ws);
  ASSERT_TRUE(e) << e.message;
  const auto& touch = m.contacts[0];
  EXPECT_GT(touch->energy(e.x, touch.values(e.parameters)), 0);
  EXPECT_LT(max_penetration(m, e.x, e.parameters), 1e-4);
}

/// The blade ends above the middle of the block's upper faces and touches none of their nodes.
TEST(Contact, ABladeBetweenTheNodesDoesNotCutIntoAFace) {
  auto d = block_that_falls_upwards();
  TriangleSurface blade;  // a roof whose ridge runs along y
  const double ridge = 0.0105, x = 0.0075;
  blade.vertices = {
      {x - 0.01, -0.01, ridge + 0.02}, {x, -0.01, ridge}, {x + 0.01, -0.01, ridge + 0.02},
      {x - 0.01, 0.02, ridge + 0.02},  {x, 0.02, ridge},  {x + 0.01, 0.02, ridge + 0.02}};
  blade.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  d.palate = blade;
  const Model m = build_model(d, "block");
  Workspace ws(m);
  const auto e = pulled_up(d, m, ws);
  ASSERT_TRUE(e) << e.message;
  EXPECT_LT(max_penetration(m, e.x, e.parameters), 1e-4);
  const BoneDistance bone(facing_tongue(blade, m.mesh.nodes));
  for (const Quad& face : boundary_quads(m.mesh))
    for (double u = 0; u <= 1; u += 0.04)
      for (double v = 0; v <= 1; v += 0.04)
        EXPECT_GT(bone(blend(e.x, face, {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v})),
                  -1e-4);
}

}  // namespace
}  // namespace genio
