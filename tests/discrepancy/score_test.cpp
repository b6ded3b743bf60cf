// Signatures are derivatives of what is measured; scores see what they should and nothing else.

#include "discrepancy/candidates/score.hpp"

#include <cmath>

#include "discrepancy/candidates/response.hpp"
#include "discrepancy/errors/error_model.hpp"
#include "forward/model/build_model.hpp"
#include "inverse/target/comparison.hpp"
#include "tests/discrepancy/posed_tongue.hpp"

namespace genio {
namespace {

class Scores : public test::FittedTongue {
 protected:
  void look_at(const ModelDescription& truth) { look_at(truth, tongue); }
  void look_at(const ModelDescription& truth, const ModelDescription& model) {
    ASSERT_NO_FATAL_FAILURE(fit_to(truth, with_mobile_supports(model)));
    errors.matrix = residual_covariance(*set, f, influences, {}, {});
    errors.covariance.compute(errors.matrix);
    f = fit(*set, {}, &errors, {.start = f.conditions});
    ASSERT_TRUE(f.converged) << f.message;
    influences = influences_of(*set, f);
    all = candidates(model, observations);
  }
  Errors errors;
  std::vector<Candidate> all;
};

TEST_F(Scores, SignatureIsTheDerivativeOfTheResiduals) {
  look_at(tongue);
  for (const char* name : {"gravity", "jaw_opening", "airway_pressure", "force_length"}) {
    const auto c =
        std::find_if(all.begin(), all.end(), [&](const Candidate& k) { return k.effect == name; });
    ASSERT_NE(c, all.end());
    const Matrix exact = signature(*c, *set, f, influences);
    // The first strength a little off its absent value, forces as they are.
    const FreeNumber& n = c->strengths.front();
    const double h = 1e-3 * n.belief.typical;
    ModelDescription with = c->hypothesis->added_to(set->description());
    with.effects[c->effect][n.keys.front()] = n.info.absent + h;
    const Model m = build_model(with, "with");
    Workspace ws(m);
    Parameters p = default_parameters(m);
    const FittedCondition& fitted = f.conditions[0];
    for (size_t k = 0; k < set->model(0).parameters.size(); ++k) {
      const std::string key = set->model(0).parameters[k].name.text();
      if (!key.starts_with(c->effect))
        p[parameter_index(m, key)] = fitted.parameters[Eigen::Index(k)];
    }
    const auto e = solve_equilibrium(m, p, fitted.x, ws);
    ASSERT_TRUE(e) << e.message;
    const Vector change =
        (Comparison(m, observations.conditions[0].target)(e.x).values - fitted.residuals.values) /
        h;
    const Vector told = exact.col(0).head(change.size());
    EXPECT_LT((change - told).norm(), 0.03 * told.norm()) << name;
  }
}

TEST_F(Scores, NothingHiddenScoresLowAndAHiddenEffectHighest) {
  look_at(tongue);
  {
    const Projection projection(f, errors.covariance);
    const auto scores = score(all, *set, f, influences, projection);
    EXPECT_LT(scores.front().log_evidence, 1);
  }
  ModelDescription truth = tongue;
  truth.effects["airway_pressure"] = {{"pressure", 400}};
  look_at(truth);
  const Projection projection(f, errors.covariance);
  const auto scores = score(all, *set, f, influences, projection);
  EXPECT_EQ(all[scores.front().candidate].effect, "airway_pressure");
  EXPECT_NEAR(scores.front().estimate[0], 400, 150);  // a step that does not see the jaw
  EXPECT_LT(scores.front().p, 1e-6);
}

TEST_F(Scores, ATongueThatIsPulledUpHasNoGravityDownwards) {
  ModelDescription truth = tongue;
  truth.effects["gravity"] = {{"x", 0}, {"y", 0}, {"z", 12}};
  look_at(truth);
  const Projection projection(f, errors.covariance);
  const auto of_gravity = [&](const std::vector<Score>& scores) {
    return *std::find_if(scores.begin(), scores.end(),
                         [&](const Score& s) { return all[s.candidate].effect == "gravity"; });
  };
  const Score downwards = of_gravity(score(all, *set, f, influences, projection));
  EXPECT_EQ(downwards.estimate[2], 0);
  for (Candidate& c : all)
    if (c.effect == "gravity") c.strengths[2].info.upper = 20;
  const Score either = of_gravity(score(all, *set, f, influences, projection));
  EXPECT_GT(either.estimate[2], 5);
  EXPECT_GT(either.log_evidence, downwards.log_evidence + 10);
}

TEST_F(Scores, ASwitchPaysForNoStrength) {
  ModelDescription touching = tongue;
  for (Vec3& v : touching.palate->vertices) v[2] -= 8e-3;
  touching.effects["palate_contact"] = {{"stiffness", 2e8}};
  ModelDescription bare = touching;
  bare.effects.erase("palate_contact");
  ASSERT_NO_FATAL_FAILURE(look_at(touching, bare));
  const Projection projection(f, errors.covariance);
  for (const Score& s : score(all, *set, f, influences, projection)) {
    if (all[s.candidate].effect != "palate_contact") continue;
    EXPECT_TRUE(all[s.candidate].is_switch());
    EXPECT_GT(s.statistic, 4);
    EXPECT_DOUBLE_EQ(s.log_evidence, 0.5 * s.statistic);
    return;
  }
  FAIL() << "no palate to touch";
}

TEST_F(Scores, NoFitStartsFromConditionsThatAreMissing) {
  look_at(tongue);
  f.conditions.pop_back();
  const JointFit again = fit(*set, {}, &errors, {.start = f.conditions});
  EXPECT_FALSE(again.converged);
  EXPECT_FALSE(again.message.empty());
}

TEST_F(Scores, AnEstimateAtItsBoundIsOneThatAModelTakesAndHasAnInterval) {
  ModelDescription truth = tongue, stiffer = tongue;
  truth.effects["stiff_region"] = {
      {"factor", 0.05}, {"x", 0.1}, {"y", 0}, {"z", 0.1}, {"radius", 0.015}};
  stiffer.effects["stiff_region"] = truth.effects["stiff_region"];
  stiffer.effects["elasticity"]["a10"] *= 1.5;
  const Observations o = observed(truth, true);
  ConditionSet stiff(stiffer, o, fitted_conditions(o));
  SharedPrior shared;
  shared.parameters[{"stiff_region", "factor"}] = {1, 4};
  const JointFit joint = fit(stiff, shared, nullptr);
  ASSERT_EQ(joint.shared.size(), 1u) << joint.message;
  EXPECT_EQ(joint.shared[0].value, 0.05);
  EXPECT_EQ(joint.shared[0].low, 0.05);
  EXPECT_GT(joint.shared[0].high, 0.06);
  stiffer.effects["stiff_region"]["factor"] = joint.shared[0].value;
  EXPECT_NO_THROW(build_model(stiffer, "patched"));
}

TEST_F(Scores, CommandsAnswerToWhatComesInAndGoesAwayAsAFitDoes) {
  ModelDescription truth = tongue;
  truth.effects["airway_pressure"] = {{"pressure", 150}};
  look_at(truth);
  const auto airway = std::find_if(
      all.begin(), all.end(), [](const Candidate& c) { return c.effect == "airway_pressure"; });
  ASSERT_NE(airway, all.end());
  ConditionSet more(airway->hypothesis->added_to(tongue), observations,
                    fitted_conditions(observations));
  SharedPrior shared;
  shared.parameters[{"airway_pressure", "pressure"}] = {0, 200};
  const JointFit there = fit(more, shared, &errors, {.start = f.conditions});
  ASSERT_TRUE(there.converged) << there.message;
  const auto apart = [](const std::vector<FittedCondition>& a,
                        const std::vector<FittedCondition>& b) {
    double sum = 0;
    for (size_t k = 0; k < a.size(); ++k) {
      const auto own = std::min(a[k].z.size(), b[k].z.size());
      sum += (a[k].z.head(own) - b[k].z.head(own)).squaredNorm();
    }
    return std::sqrt(sum);
  };
  const double between = apart(there.conditions, f.conditions);
  EXPECT_LT(apart(without_candidate(*airway, there, errors), f.conditions), 0.5 * between);
  EXPECT_LT(
      apart(with_candidate(*airway, there.shared, *set, f, errors, influences), there.conditions),
      0.3 * between);
}

TEST_F(Scores, AFitFromAnOpenJawHasItsJawShut) {
  ModelDescription open = tongue;
  open.effects["jaw_opening"] = {{"angle", 1}};
  const Observations seen = observed(open, true);
  const auto conditions = fitted_conditions(seen);
  ConditionSet shut(tongue, seen, conditions), opened(open, seen, conditions);
  const JointFit before = fit(shut, {}, nullptr);
  const JointFit there = fit(opened, {}, nullptr, {.start = before.conditions});
  ASSERT_TRUE(before.converged && there.converged) << before.message << there.message;
  const JointFit after = fit(shut, {}, nullptr, {.start = there.conditions});
  ASSERT_TRUE(after.converged) << after.message;
  EXPECT_NEAR(after.value, before.value, 1e-2 * before.value);
  EXPECT_GT(after.value, 1.5 * there.value);
}

TEST_F(Scores, ProjectionTakesAwayWhatTheUnknownsCanDo) {
  look_at(tongue);
  const Projection projection(f, errors.covariance);
  const Matrix p = projection(f.jacobian());
  // What is left of a tangent is what the prior holds back; twice is once.
  const Matrix r = projection(Matrix::Identity(f.jacobian().rows(), f.jacobian().rows()));
  EXPECT_LE(p.norm(), Matrix(errors.covariance.matrixL().solve(f.jacobian())).norm());
  EXPECT_LE(r.colwise().norm().maxCoeff(),
            Matrix(errors.covariance.matrixL().solve(Matrix::Identity(r.cols(), r.cols())))
                    .colwise()
                    .norm()
                    .maxCoeff() *
                (1 + 1e-9));
  EXPECT_GT(projection.dof(), 0);
  EXPECT_LT(projection.dof(), double(f.residuals().size()));
}

}  // namespace
}  // namespace genio
