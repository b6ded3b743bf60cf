// How far residuals may be from zero although nothing is missing.

#include "discrepancy/errors/error_model.hpp"

#include <cmath>
#include <numbers>

#include "discrepancy/errors/errors.hpp"
#include "forward/model/build_model.hpp"
#include "inverse/target/comparison.hpp"
#include "tests/discrepancy/posed_tongue.hpp"

namespace genio {
namespace {

class ErrorModelOfAFit : public test::FittedTongue {};

TEST_F(ErrorModelOfAFit, TurnedFibresStillBalance) {
  ASSERT_NO_FATAL_FAILURE(fit_to(tongue, tongue));
  const FittedCondition& c = f.conditions[0];
  Matrix sum = Matrix::Zero(3, c.x.size());
  for (Eigen::Index i = 0; i < c.x.size(); ++i) sum(i % 3, i) = 1;
  const Matrix total = fibre_influence(set->model(0), c, sum);
  // Of a single node's force a turn makes something.
  Matrix single = Matrix::Zero(1, c.x.size());
  single(0, 3 * set->model(0).muscles[0].fibres[0][1].node) = 1;
  const double some = fibre_influence(set->model(0), c, single).norm();
  EXPECT_GT(some, 0);
  EXPECT_LT(total.norm(), 1e-9 * some);
}

TEST(FibreCovariance, HasTheAngleOfTheErrorModelOnBothSidesAndMostOfItAlike) {
  const Model m = read_model(test::generic_model());
  const ErrorModel error_model;
  const double slope =
      error_model.fibre_turn * std::numbers::pi / 180 / std::sqrt(std::numbers::pi / 2);
  const double variance = std::pow(slope * error_model.fibre_length, 2);
  for (int axis : {0, 1, 2}) {
    const Covariance c = fibre_covariance(m, error_model, axis);
    const auto n = Eigen::Index(m.mesh.nodes.size());
    EXPECT_LT(covariance_root(n, c, 1e-2).cols(), n / 2);
    for (Eigen::Index a = 0; a < n; ++a) {
      const Vec3& x = m.mesh.nodes[size_t(a)];
      if (std::abs(x[1]) < 1e-6 && axis == 1) continue;  // alike, it stays in the plane
      EXPECT_NEAR(c(a, a), variance, 1e-9 * variance);
      for (Eigen::Index b = 0; b < n; ++b) {
        const Vec3& y = m.mesh.nodes[size_t(b)];
        if (x[1] < 0.015 || (Vec3(x[0], -x[1], x[2]) - y).norm() > 1e-6) continue;
        EXPECT_NEAR(c(a, b), (axis == 1 ? -1 : 1) * error_model.fibres_alike * variance,
                    2e-3 * variance);
      }
    }
  }
}

TEST_F(ErrorModelOfAFit, MusclesThatDoMoreForTheirForceAreForgiven) {
  ASSERT_NO_FATAL_FAILURE(fit_to(tongue, tongue));
  ErrorModel error_model;
  error_model.efficacy_sd = 0.2;
  const Matrix c = efficacy_covariance(*set, f, influences, error_model);
  EXPECT_TRUE(c.isApprox(c.transpose()));
  // One condition's muscles, all 20 % stronger: to first order what the covariance expects.
  const FittedCondition& one = f.conditions[0];
  Parameters stronger = one.parameters;
  const Model& m = set->model(0);
  constexpr double step = 1e-3;
  double pulling = 0;
  for (const Muscle& muscle : m.muscles) {
    double& force = stronger[parameter_index(m, "muscles." + muscle.name)];
    pulling += force > 0, force *= 1 + step;
  }
  ASSERT_GT(pulling, 0);
  Workspace ws(m);
  const auto before = solve_equilibrium(m, one.parameters, one.x, ws),
             after = solve_equilibrium(m, stronger, one.x, ws);
  const Comparison compare(m, observations.conditions[set->members()[0]].target);
  const Vector moved = (compare(after.x).values - compare(before.x).values) / step;
  const auto n = moved.size();
  const Matrix block =
      c.topLeftCorner(n, n) + 1e-5 * c.trace() / double(n) * Matrix::Identity(n, n);
  const double chi_square = (0.2 * moved).dot(block.llt().solve(0.2 * moved));
  EXPECT_GT(chi_square, 0.5);
  EXPECT_LT(chi_square, 4 * pulling);
}

TEST(NoiseCovariance, IsWhiteWithoutALengthAndPositiveDefiniteWithOne) {
  const Model m = read_model(test::generic_model());
  Target t = curve_target(m, m.rest, 40, 5e-4);
  t.surface.push_back({Vec3(0.1, 0.01, 0.12), 5e-4, 1});
  const Residuals r = Comparison(m, t)(m.rest);
  EXPECT_TRUE(noise_covariance(t, r, 0).isIdentity(0));
  const Matrix c = noise_covariance(t, r, 8e-3);
  EXPECT_TRUE(c.isApprox(c.transpose()));
  EXPECT_EQ(Eigen::LLT<Matrix>(c).info(), Eigen::Success);
  EXPECT_GT(c(10, 11), 0.3);
  EXPECT_EQ(c(10, 40), 0);  // another contour
}

TEST(NoiseCovariance, OfPointsShiftedAlongADimpledSurfaceChangesSign) {
  const Model m = read_model(test::generic_model());
  const Target t = curve_target(m, m.rest, 40, 5e-4);
  Residuals r = Comparison(m, t)(m.rest);
  for (size_t i = 0; i < r.gradient.size(); ++i)
    r.gradient[i] = {{0, Vec3(i % 2 == 0 ? 1 : -1, 0, 1)}};  // 45 degrees, to and fro
  const Matrix c = noise_covariance(t, r, 8e-3);
  const double apart = (r.places[10] - r.places[12]).norm();
  EXPECT_NEAR(c(10, 11), 0, 1e-12);
  EXPECT_NEAR(c(10, 12), std::exp(-apart / 8e-3), 1e-12);
}

Errors errors_of(double variance) {
  Errors e;
  e.matrix = variance * Matrix::Identity(10, 10);
  e.covariance.compute(e.matrix);
  return e;
}

TEST(Errors, AFitThatItsOwnErrorsDoNotFollowRunsAway) {
  JointFit last, next;
  last.value = 20, next.value = 60;
  const Errors wide = errors_of(100), narrow = errors_of(1);
  EXPECT_FALSE(runs_away(next, narrow, last, wide, 30));  // 60 of 20 + 10 log 10 + 30
  EXPECT_TRUE(runs_away(next, narrow, last, wide, 10));
  EXPECT_TRUE(runs_away(next, narrow, last, narrow, 30));
  EXPECT_FALSE(runs_away(next, narrow, last, Errors(), 0));  // nothing to hold on to
}

}  // namespace
}  // namespace genio
