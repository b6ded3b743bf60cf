#include "forward/statics/curved_step.hpp"

#include <gtest/gtest.h>

#include "forward/geometry/box_mesh.hpp"

namespace genio {
namespace {

/// A slender beam clamped at x = 0 and a step that bends it upwards by an angle `turn` at its end.
struct Beam {
  HexMesh mesh = box_mesh(Vec3(0.06, 0.01, 0.01), {12, 2, 2});
  std::vector<Support> supports;
  Positions rest = rest_positions(mesh);

  Beam() {
    for (const Vec3& x : mesh.nodes)
      supports.push_back(x[0] < 1e-9 ? Support::fixed : Support::free);
  }
  Vector bend(double turn) const {
    Vector step(rest.size());
    for (size_t a = 0; a < mesh.nodes.size(); ++a) {
      const double s = mesh.nodes[a][0], height = mesh.nodes[a][2] - 0.005;
      const double k = turn / 0.06;
      step.segment<3>(Eigen::Index(3 * a)) = Vec3(-k * s * height, 0, 0.5 * k * s * s);
    }
    return step;
  }
};

TEST(CurvedStep, IsTheStraightStepToFirstOrder) {
  const Beam b;
  const CurvedStep curved(b.mesh, b.supports);
  const auto off = [&](double turn) {
    const Vector step = b.bend(turn);
    return (curved(b.rest, step) - b.rest - step).norm();
  };
  EXPECT_GT(off(0.4), 0);
  EXPECT_NEAR(off(0.4) / off(0.2), 4, 0.5);  // the difference is of second order
  EXPECT_LT(off(1e-4), 1e-12);               // and none where the step is nearly straight
}

TEST(CurvedStep, KeepsLengthAndVolumeWhereAStraightStepSwells) {
  const Beam b;
  const CurvedStep curved(b.mesh, b.supports);
  const Vector step = b.bend(1.2);
  const double volume = mesh_volume(b.mesh, b.rest);
  const double straight = mesh_volume(b.mesh, Positions(b.rest + step)) / volume - 1;
  const double turned = mesh_volume(b.mesh, curved(b.rest, step)) / volume - 1;
  EXPECT_GT(straight, 0.1);
  EXPECT_LT(std::abs(turned), 0.02);
}

TEST(CurvedStep, SupportedNodesFollowTheStep) {
  Beam b;
  const CurvedStep curved(b.mesh, b.supports);
  Vector step = b.bend(0.8);
  step[0] = 1e-3;
  const Positions y = curved(b.rest, step);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(y[i], b.rest[i] + step[i]);
}

}  // namespace
}  // namespace genio
