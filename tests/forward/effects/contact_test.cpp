#include "forward/effects/surroundings/contact.hpp"

#include <gtest/gtest.h>

#include "forward/geometry/closest_point.hpp"
#include "forward/geometry/distance_field.hpp"
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

TEST(SurfaceDistance, IsSignedAndExactAtFacesEdgesAndVertices) {
  const SurfaceDistance d(octahedron(1));
  EXPECT_NEAR(d({2, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(d({1, 1, 0}), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(d({1, 1, 1}), 2 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(d({0, 0, 0}), -1 / std::sqrt(3.0), 1e-12);
}

TEST(DistanceField, GradientAndHessianAreItsDerivatives) {
  const DistanceField f(octahedron(0.01), Vec3::Constant(-0.02), Vec3::Constant(0.02), 2e-3,
                        {Vec3(0.015, 0.015, 0.015)});
  const Vec3 p(0.0061, 0.0043, 0.0004);  // near an edge, where it bends
  const auto s = f.sample(p);
  for (int i = 0; i < 3; ++i) {
    const Vec3 h = 1e-6 * Vec3::Unit(i);
    EXPECT_NEAR((f.value(p + h) - f.value(p - h)) / 2e-6, s.gradient[i], 1e-7);
    const Vec3 slope = (f.sample(p + h).gradient - f.sample(p - h).gradient) / 2e-6;
    EXPECT_LE((slope - s.hessian.col(i)).norm(), 1e-4 * s.hessian.norm());
  }
}

TEST(Contact, HoldsTheBlockBelowThePalate) {
  auto d = test::small_block();
  d.effects["elasticity"]["kappa"] = 192000;
  d.effects["palate_contact"]["stiffness"] = 2e8;
  d.effects["gravity"] = {{"x", 0}, {"y", 0}, {"z", 19}};  // falls upwards
  const Model m = build_model(d, "block");
  Workspace ws(m);
  const auto e = solve_equilibrium(m, default_parameters(m), m.rest, ws);
  ASSERT_TRUE(e) << e.message;
  EXPECT_GT(max_penetration(m, e.x, e.parameters), 0);
  EXPECT_LT(max_penetration(m, e.x, e.parameters), 1e-4);
}

}  // namespace
}  // namespace genio
