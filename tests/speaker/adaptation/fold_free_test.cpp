// The energy that keeps elements from folding: its derivatives, and that it does.

#include "speaker/elastic/fold_free.hpp"

#include <Eigen/Geometry>

#include "speaker/adaptation/solid_registration.hpp"
#include "speaker/elastic/corner_shape.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/speaker/shapes.hpp"

namespace genio {
namespace {

Mat3 some_deformation() {
  return (Mat3() << 1.3, 0.2, -0.1, 0.3, 0.7, 0.15, -0.2, 0.1, 1.1).finished();
}

FoldFreeProblem problem_on(const HexMesh& mesh) {
  FoldFreeProblem p{&mesh, corner_shapes(mesh), {}, 3e-5, 2e-5, 0.9, {}, {}};
  const Positions x = rest_positions(mesh);
  for (size_t e = 0; e < mesh.elements.size(); ++e)
    p.volumes.push_back(element_volume(mesh, x, int(e)));
  p.supports.assign(mesh.nodes.size(), Support::free);
  return p;
}

TEST(CornerShape, EnergyVanishesForRotationsAlone) {
  const Mat3 turned = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_NEAR(corner_energy(turned), 0, 1e-12);
  EXPECT_GT(corner_energy(some_deformation()), 0.1);
  EXPECT_EQ(corner_energy(-turned), std::numeric_limits<double>::infinity());
}

TEST(CornerShape, GradientIsTheEnergysDerivative) {
  const Mat3 f = some_deformation();
  const CornerEnergy e = corner_energy_with_derivatives(f);
  EXPECT_NEAR(e.value, corner_energy(f), 1e-12);
  for (int i = 0; i < 9; ++i) {
    Mat3 up = f, down = f;
    up(i) += 1e-6, down(i) -= 1e-6;
    EXPECT_NEAR(e.gradient(i), (corner_energy(up) - corner_energy(down)) / 2e-6, 1e-6);
  }
}

TEST(CornerShape, StiffnessIsTheGradientsDerivativeWhereItIsPositive) {
  // A stretched corner, whose Hessian has no negative eigenvalue to be cut off.
  const Mat3 f = 1.4 * Mat3::Identity() + 0.1 * some_deformation();
  const CornerEnergy e = corner_energy_with_derivatives(f);
  for (int i = 0; i < 9; ++i) {
    Mat3 up = f, down = f;
    up(i) += 1e-5, down(i) -= 1e-5;
    const Mat3 expected = (corner_energy_with_derivatives(up).gradient -
                           corner_energy_with_derivatives(down).gradient) /
                          2e-5;
    Mat3 found = Mat3::Zero();
    for (size_t d = 0; d < 9; ++d) found += e.stiffness[d] * e.direction[d](i) * e.direction[d];
    EXPECT_LT((found - expected).norm(), 1e-5 * expected.norm());
  }
}

TEST(FoldFree, GradientIsTheEnergysDerivative) {
  const ModelDescription block = test::small_block();
  FoldFreeProblem p = problem_on(block.mesh);
  const auto& nodes = block.mesh.elements.front();
  p.pulls.push_back({{nodes[0], nodes[1], nodes[2], -1},
                     {0.2, 0.5, 0.3, 0},
                     Vec3(1e-3, 2e-3, 0),
                     Mat3::Identity()});
  Positions x = rest_positions(block.mesh);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += 2e-4 * std::sin(double(7 * i));
  const Vector gradient = fold_free_gradient(p, x);
  for (Eigen::Index i = 0; i < x.size(); i += 5) {
    Positions up = x, down = x;
    up[i] += 1e-8, down[i] -= 1e-8;
    const double expected = (fold_free_energy(p, up) - fold_free_energy(p, down)) / 2e-8;
    EXPECT_NEAR(gradient[i], expected, 1e-5 * gradient.cwiseAbs().maxCoeff());
  }
}

TEST(FoldFree, NeverFoldsAnElementHoweverHardItIsPulled) {
  const ModelDescription block = test::small_block();
  FoldFreeProblem p = problem_on(block.mesh);
  // One corner is drawn through the whole block and out at the other side.
  p.pulls.push_back({{0, -1, -1, -1}, {1, 0, 0, 0}, Vec3(0.2, 0.2, 0.2), Mat3::Identity()});
  const FoldFreeResult r = minimise_fold_free(p, rest_positions(block.mesh));
  HexMesh moved = block.mesh;
  for (size_t a = 0; a < moved.nodes.size(); ++a) moved.nodes[a] = node_position(r.x, int(a));
  EXPECT_GT(least_corner_jacobian_ratio(moved), 0);
  EXPECT_GT((moved.nodes[0] - block.mesh.nodes[0]).norm(), 1e-3);
}

}  // namespace
}  // namespace genio
