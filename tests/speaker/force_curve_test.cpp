// Laws of the force that an indented block answers with.

#include "speaker/indentation/force_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace genio {
namespace {

const BlockGrid coarse{2, 0.25, 1.8};

IndentationExperiment small_block(Indenter indenter) {
  return {.indenter = indenter,
          .radius = 5e-3,
          .thickness = 12e-3,
          .half_width = 20e-3,
          .mucosa = 2e-3};
}

const BlockTissue layered{{192, 90}, {384, 180}};

double& constant(BlockTissue& t, int k) {
  double* const all[] = {&t.muscle.a10, &t.muscle.a20, &t.mucosa.a10, &t.mucosa.a20};
  return *all[k];
}

class EveryIndenter : public testing::TestWithParam<Indenter> {
 protected:
  EveryIndenter() : model(small_block(GetParam()), 2e-3, layered, coarse), ws(model.model) {}

  ForceCurve solve(const BlockTissue& tissue, double depth = 2e-3) {
    ForceCurve c = solve_force_curve(model, tissue, std::vector{depth}, ws);
    EXPECT_TRUE(c) << c.message;
    return c;
  }

  IndentationModel model;
  Workspace ws;
};

// Central differences err as the square of the step, until rounding takes over: the best of a row
// of steps is far better than its ends.
TEST_P(EveryIndenter, HasTheDerivativesOfItsForceByConstantsAndDepth) {
  const ForcePoint at = solve(layered).points.back();
  for (int k = 0; k <= block_constants; ++k) {
    const bool by_depth = k == block_constants;
    const double exact = by_depth ? at.slope : at.derivative[size_t(k)];
    double first = 0, best = 1e9;
    for (const double part : {0.2, 0.02, 0.002, 0.0002}) {
      const auto force = [&](double sign) {
        BlockTissue t = layered;
        double depth = 2e-3;
        (by_depth ? depth : constant(t, k)) *= 1 + sign * part;
        return solve(t, depth).points.back().force;
      };
      BlockTissue t = layered;
      const double step = part * (by_depth ? 2e-3 : constant(t, k));
      const double error = std::abs((force(1) - force(-1)) / (2 * step) / exact - 1);
      if (first == 0) first = error;
      best = std::min(best, error);
    }
    EXPECT_LT(best, 2e-4) << "constant " << k;
    EXPECT_LT(best, 0.2 * first + 1e-9) << "constant " << k;
  }
}

TEST_P(EveryIndenter, NeedsForcesThatAreLinearInAllConstantsTogether) {
  const ForcePoint at = solve(layered).points.back();
  double sum = 0;
  BlockTissue t = layered;
  for (int k = 0; k < block_constants; ++k) sum += constant(t, k) * at.derivative[size_t(k)];
  EXPECT_NEAR(sum / at.force, 1, 0.005);  // but for the little that the indenter gives way
}

TEST_P(EveryIndenter, PressesTheMoreTheDeeperAndTheStifferTheTissue) {
  const std::vector depths{0.5e-3, 1e-3, 1.5e-3, 2e-3};
  const ForceCurve c = solve_force_curve(model, layered, depths, ws);
  ASSERT_TRUE(c) << c.message;
  for (size_t i = 1; i < depths.size(); ++i) EXPECT_GT(c.points[i].force, c.points[i - 1].force);
  for (const double d : c.points.back().derivative) EXPECT_GT(d, 0);
}

TEST_P(EveryIndenter, GivesTheSameForceFromANearCurve) {
  BlockTissue other = layered;
  other.muscle.a10 *= 1.2;
  const ForceCurve near = solve(other), alone = solve(layered);
  const ForceCurve led = solve_force_curve(model, layered, std::vector{2e-3}, ws, &near);
  ASSERT_TRUE(led) << led.message;
  EXPECT_NEAR(led.points[0].force / alone.points[0].force, 1, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Indentation, EveryIndenter,
                         testing::Values(Indenter::punch, Indenter::sphere, Indenter::pressure),
                         [](const auto& i) { return to_string(i.param); });

TEST(Indentation, RefusesExperimentsThatCannotBe) {
  IndentationExperiment e;
  EXPECT_THROW(IndentationModel(e, 19e-3, layered), InputError);  // through the block
  EXPECT_THROW(IndentationModel(e, 0, layered), InputError);
  e.radius = 5;  // millimetres
  EXPECT_THROW(IndentationModel(e, 1e-3, layered), InputError);
  e = {.mucosa = 30e-3};
  EXPECT_THROW(IndentationModel(e, 1e-3, layered), InputError);
  e = {.poisson_ratio = 0.5};
  EXPECT_THROW(IndentationModel(e, 1e-3, layered), InputError);
}

}  // namespace
}  // namespace genio
