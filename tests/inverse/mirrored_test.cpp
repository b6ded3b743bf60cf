// What a shape does not tell of left and right is told.

#include "inverse/shape/mirrored.hpp"

#include "inverse/target/comparison.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class MirroredForces : public test::PulledTongue {
 protected:
  /// GGP pulls left, and the target is the curve of that or the nodes of its surface.
  std::optional<double> mixed(bool in_3d) {
    Parameters p = default_parameters(m);
    set_command(m, "GGP_L", 4, p);
    const auto e = solve_equilibrium(m, p, m.rest, ws);
    EXPECT_TRUE(e) << e.message;
    Target target = curve_target(m, e.x, 40, 5e-4);
    if (in_3d)
      for (const Quad& face : m.surface)
        target.flesh.push_back({{{face[0], 1.0}}, node_position(e.x, face[0]), 5e-4, "node"});
    const Comparison comparison(m, target);
    InferOptions options;
    options.bilateral = false;
    Objective objective(m, comparison, Prior{}, options, ws);
    Vector z = Vector::Zero(Eigen::Index(objective.unknowns().size()));
    for (size_t i = 0; i < objective.unknowns().size(); ++i)
      if (objective.unknowns()[i].name == "GGP_L") left = Eigen::Index(i);
      else if (objective.unknowns()[i].name == "GGP_R") right = Eigen::Index(i);
    z[left] = 4 / objective.unknowns()[size_t(left)].scale;
    const ObjectivePoint* found = objective.derivatives(z);
    EXPECT_TRUE(found);
    const ObjectivePoint point = *found;
    posterior = acting_posterior(point, objective.unknowns(), objective.prior(), {}, 5e-3);
    before = posterior.samples;
    return mix_mirrored(objective, point, posterior);
  }

  Eigen::Index left = -1, right = -1;
  ActingPosterior posterior;
  WeightedSamples before;
};

TEST_F(MirroredForces, AMidsagittalCurveTellsNoSideSoBothAreMixedHalfAndHalf) {
  const auto share = mixed(false);
  ASSERT_TRUE(share);
  EXPECT_NEAR(*share, 0.5, 1e-3);
  const auto& [values, weights] = posterior.samples;
  EXPECT_NEAR(weights.sum(), 1, 1e-9);
  EXPECT_NEAR(values.row(left).dot(weights), values.row(right).dot(weights), 1e-3);
  EXPECT_EQ(values.cols(), 2 * before.values.cols());
}

TEST_F(MirroredForces, AShapeThatTellsItsSidesIsNotMixed) {
  EXPECT_FALSE(mixed(true));
  EXPECT_EQ(posterior.samples.values.cols(), before.values.cols());
}

}  // namespace
}  // namespace genio
