// Constants that were put in come out of the fit.

#include "speaker/indentation/tissue_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "speaker/indentation/simulated_data.hpp"

namespace genio {
namespace {

const BlockGrid fit_grid{2, 0.15, 1.6};
const BlockTissue rear{{1160.0 / 6, 90.6}, {384, 180}};

IndentationExperiment ball(double mucosa) {
  return {.indenter = Indenter::sphere,
          .radius = 7e-3,
          .thickness = 15e-3,
          .half_width = 30e-3,
          .mucosa = mucosa};
}

TissueFit fitted(double mucosa, const ForceData& data, bool fit_mucosa = false) {
  return fit_tissue(ball(mucosa), data,
                    {.mucosa = rear.mucosa, .fit_mucosa = fit_mucosa, .grid = fit_grid});
}

class Layers : public testing::TestWithParam<double> {};

TEST_P(Layers, AreFoundWithinTwoAndTenPercentFromFivePercentScatter) {
  const double mucosa = GetParam();
  const ForceData data = simulated_data(ball(mucosa), rear, 7e-3, 200, 0.05, 1, fit_grid);
  const TissueFit fit = fitted(mucosa, data);
  ASSERT_TRUE(fit) << fit.message;
  EXPECT_NEAR(fit.tissue.muscle.a10 / rear.muscle.a10, 1, 0.02);
  EXPECT_NEAR(fit.tissue.muscle.a20 / rear.muscle.a20, 1, 0.10);
  EXPECT_DOUBLE_EQ(fit.young_modulus, 6 * fit.tissue.muscle.a10);
  EXPECT_LE(fit.simulations, 60);
  EXPECT_NEAR(fit.chi2_per_dof, 1, 0.4);
  // Stiffer at first or stiffer later: the two trade against one another.
  EXPECT_LT(fit.covariance(0, 1), 0);
  EXPECT_DOUBLE_EQ(fit.covariance(0, 1), fit.covariance(1, 0));
}

INSTANTIATE_TEST_SUITE_P(TissueFit, Layers, testing::Values(0.0, 1e-3));

TEST(TissueFit, FindsTheMucosaTooWhereNothingScatters) {
  ForceData data = simulated_data(ball(1e-3), rear, 6e-3, 8, 0, 1, fit_grid);
  const TissueFit fit = fitted(1e-3, data, true);
  ASSERT_TRUE(fit) << fit.message;
  ASSERT_EQ(fit.constants.size(), 3u);
  EXPECT_NEAR(fit.constants[0].value / rear.muscle.a10, 1, 0.005);
  EXPECT_NEAR(fit.constants[1].value / rear.muscle.a20, 1, 0.02);
  EXPECT_NEAR(fit.constants[2].value / rear.mucosa.a10, 1, 0.01);
}

TEST(TissueFit, EstimatesTheScatterThatNobodyTold) {
  ForceData data = simulated_data(ball(0), rear, 5e-3, 60, 0.05, 3, fit_grid);
  data.sd.reset();
  const TissueFit fit = fit_tissue(ball(0), data, {.relative_scatter = true, .grid = fit_grid});
  ASSERT_TRUE(fit) << fit.message;
  EXPECT_NEAR(fit.scatter, 0.05, 0.015);
  EXPECT_GT(fit.constants[0].sd, 0);
}

TEST(TissueFit, KeepsConstantsAboveTheirBoundsAndSaysSo) {
  // Forces that grow less than linearly under a sphere want a negative a20.
  ForceData data = simulated_data(ball(0), {{192, 0}, {}}, 5e-3, 8, 0, 1, fit_grid);
  for (Eigen::Index i = 0; i < data.force.size(); ++i)
    data.force[i] *= 1 - 0.1 * data.depth[i] / 5e-3;
  const TissueFit fit = fitted(0, data);
  ASSERT_TRUE(fit) << fit.message;
  EXPECT_GE(fit.constants[1].value, 0);
  EXPECT_TRUE(fit.constants[1].at_bound);
  EXPECT_EQ(fit.constants[1].low, 0);
}

TEST(TissueFit, EndsWithAReasonWhereSimulationsAreUsedUp) {
  const ForceData data = simulated_data(ball(0), rear, 3e-3, 6, 0, 1, fit_grid);
  const TissueFit fit = fit_tissue(ball(0), data, {.most_simulations = 1, .grid = fit_grid});
  EXPECT_FALSE(fit);
  EXPECT_NE(fit.message.find("1 simulations"), std::string::npos) << fit.message;
}

}  // namespace
}  // namespace genio
