#include "inverse/shape/infer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "inverse/shape/objective.hpp"
#include "inverse/target/comparison.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

using Infer = test::PulledTongue;

TEST_F(Infer, MeetsASimulatedShapeFromRest) {
  const auto a = infer(m, pulled({{"GGP", 2.8}, {"SL", 1.2}, {"GH", 0.9}}), Prior{}, ws);
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  EXPECT_LT(1e3 * a.rms, 0.05);
  EXPECT_EQ(a.verdict, Verdict::explained);
  for (const auto& c : a.muscles) {
    EXPECT_GE(c.best, 0);
    EXPECT_LE(c.best, c.maximum);
    EXPECT_LE(c.low, c.median + 1e-9);
    EXPECT_GE(c.high, c.median - 1e-9);
    EXPECT_GE(c.acts, 0);
    EXPECT_LE(c.acts, 1);
    EXPECT_GT(c.sd, 0);
  }
}

TEST_F(Infer, TellsWhatActsFromWhatRests) {
  const std::map<std::string, double> forces = {{"GGP", 2.8}, {"SL", 1.2}};
  const auto a = infer(m, pulled({{"GGP", 2.8}, {"SL", 1.2}}), Prior{}, ws);
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  double resting = 0;
  for (const auto& c : a.muscles) {
    if (forces.contains(c.name)) {
      EXPECT_GT(c.acts, 0.95) << c.name;
      EXPECT_LT(c.low, forces.at(c.name)) << c.name;
      EXPECT_GT(c.high, forces.at(c.name)) << c.name;
    } else {
      EXPECT_LT(c.acts, 0.95) << c.name;
      EXPECT_EQ(c.low, 0) << c.name;
      resting += c.acts;
    }
  }
  EXPECT_LT(resting / double(a.muscles.size() - forces.size()), 0.4);
}

TEST_F(Infer, ByEffortAloneNothingRests) {
  Prior prior;
  prior.muscles_rest = false;
  const auto a = infer(m, pulled({{"GGP", 2.8}}), prior, ws);
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  for (const auto& c : a.muscles) EXPECT_TRUE(std::isnan(c.acts)) << c.name;
  EXPECT_TRUE(a.joint.empty());
}

TEST_F(Infer, KeepsWhatEmgTellsOfAForce) {
  Prior prior;
  prior.emg["GGP"] = {0.07, 0.002};
  const auto a = infer(m, pulled({{"GGP", 2.6}, {"SL", 0.6}}), prior, ws);
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  for (const auto& c : a.muscles)
    if (c.name == "GGP") {
      EXPECT_LT(c.sd / c.maximum, 0.0021);
      EXPECT_GT(c.acts, 0.99);
    }
}

TEST_F(Infer, ASilentElectrodeMakesRestLikelier) {
  Prior prior;
  prior.emg["STY"] = {0.0, 0.02};
  const Target t = pulled({{"GGP", 2.6}}, 20, 1e-3);
  const auto acts = [&](const Prior& p) {
    for (const auto& c : infer(m, t, p, ws).muscles)
      if (c.name == "STY") return c.acts;
    return std::nan("");
  };
  EXPECT_LT(acts(prior), acts(Prior{}));
}

TEST_F(Infer, AnswersWhereEveryMuscleIsFixed) {
  Prior prior;
  for (const auto& u : muscle_unknowns(m, true)) prior.fixed[u.name] = 0;
  const auto a = infer(m, pulled({{"GGP", 1}}), prior, ws);
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  for (const auto& c : a.muscles) EXPECT_EQ(c.high, 0) << c.name;
}

TEST_F(Infer, GradientIsTheDerivativeOfTheObjective) {
  const Comparison comparison(m, pulled({{"GGP", 2}, {"HG", 1}}));
  const InferOptions options;
  Objective objective(m, comparison, Prior{}, options, ws);
  const Vector z = Vector::Constant(Eigen::Index(objective.unknowns().size()), 0.02);
  const Vector gradient = objective.derivatives(z)->gradient;
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    const double h = 1e-4;
    const double up = *objective.value(z + h * Vector::Unit(z.size(), k));
    const double down = *objective.value(z - h * Vector::Unit(z.size(), k));
    EXPECT_NEAR((up - down) / (2 * h), gradient[k], 1e-4 * gradient.norm())
        << objective.unknowns()[size_t(k)].name;
  }
}

TEST_F(Infer, HessianIsTheDerivativeOfTheGradient) {
  Target t = pulled({{"GGP", 2}, {"HG", 1}});
  for (auto& p : t.curve) p.position += Vec2(1e-3, 3e-3);  // a misfit whose curvature counts
  const Comparison comparison(m, t);
  const InferOptions options;
  Objective objective(m, comparison, Prior{}, options, ws);
  const Vector z = Vector::Constant(Eigen::Index(objective.unknowns().size()), 0.02);
  const Matrix hessian = objective.exact_hessian(*objective.derivatives(z));
  const Matrix left_out = hessian - objective.gauss_newton(*objective.derivatives(z));
  EXPECT_GT(left_out.norm(), 0.05 * hessian.norm());
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    const double h = 1e-4;
    const Vector up = objective.derivatives(z + h * Vector::Unit(z.size(), k))->gradient;
    const Vector down = objective.derivatives(z - h * Vector::Unit(z.size(), k))->gradient;
    EXPECT_LT(((up - down) / (2 * h) - hessian.col(k)).norm(), 1e-3 * hessian.norm())
        << objective.unknowns()[size_t(k)].name;
  }
}

TEST_F(Infer, ShapeBeyondAllMusclesIsNotExplained) {
  Target t = curve_target(m, m.rest, 30, 3e-4);
  for (auto& p : t.curve) p.position += Vec2(-0.012, -0.012);
  InferOptions options;
  options.deadline_s = 60;
  const auto a = infer(m, t, Prior{}, ws, options);
  EXPECT_NE(a.verdict, Verdict::explained);
  EXPECT_FALSE(a.message.empty());
}

TEST_F(Infer, DeadlineAndCancelEndTheWork) {
  const Target t = pulled({{"GGP", 3}});
  InferOptions options;
  options.deadline_s = 1e-3;
  EXPECT_EQ(infer(m, t, Prior{}, ws, options).status, InferStatus::deadline);
  InferOptions cancel;
  cancel.cancelled = [] { return true; };
  EXPECT_EQ(infer(m, t, Prior{}, ws, cancel).status, InferStatus::cancelled);
}

TEST_F(Infer, WorkCutShortGivesTheBestSoFar) {
  const Target t = pulled({{"GGP", 3}});
  InferOptions cut;
  int steps = 0;
  std::vector<double> told;
  cut.progress = [&](int, double) { ++steps; };
  cut.improved = [&](const Answer& a) { told.push_back(a.rms); };
  cut.cancelled = [&] { return steps > 3; };
  const Answer a = infer(m, t, Prior{}, ws, cut);
  EXPECT_EQ(a.status, InferStatus::cancelled);
  EXPECT_FALSE(a.message.empty());
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(a.rms, told.back());
  EXPECT_LT(told.back(), told.front());
  ASSERT_EQ(a.muscles.size(), 11u);
  double pull = 0;
  for (const Estimate& e : a.muscles) {
    pull += e.best;
    EXPECT_TRUE(std::isnan(e.low)) << e.name << ": an interval was not computed";
    EXPECT_TRUE(std::isnan(e.acts)) << e.name;
  }
  EXPECT_GT(pull, 0);
  EXPECT_GT((a.shape - m.rest).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_EQ(a.verdict, Verdict::none);
}

TEST_F(Infer, EmptyTargetIsTheCallersMistake) {
  EXPECT_THROW(infer(m, Target{}, Prior{}, ws), InputError);
}

}  // namespace
}  // namespace genio
