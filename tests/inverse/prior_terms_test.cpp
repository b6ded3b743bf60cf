// Every term of the prior says the same of half a tongue as of the whole.

#include <gtest/gtest.h>

#include <algorithm>
#include <typeinfo>

#include "inverse/search/multi_start.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

/// A term at values where it does something on a bilateral tongue. A new term needs one here, or
/// this file does not link.
template <PriorTerm Term>
Term example();

template <>
EmgTerm example() {
  return {{{"GGP", {0.2, 0.05}}, {"MH", {0.1, 0.02}}}};
}
template <>
EffortTerm example() {
  return {0.3};
}
template <>
SymmetryTerm example() {
  return {0.03};
}
template <>
ParametersTerm example() {
  return {{{"elasticity.a10", {{1000, 200}}}}};
}
template <>
HeadPoseTerm example() {
  return {HeadPosePrior{2e-3, 0.02}};
}
template <>
CocontractionTerm example() {
  return {Normal{0.1, 0.02}};
}
template <>
WalkTerm example() {
  return {WalkTerm::Before{Vector::LinSpaced(11, 0, 0.2), 0.05}, 1.5};
}
template <>
FixedForcesTerm example() {
  return {{{"HG", 1.5}, {"SL", 0}}};
}

/// A prior with the example of one term, and what the others begin with.
template <PriorTerm Term>
Prior with_example() {
  Prior prior;
  static_cast<Term&>(prior) = example<Term>();
  return prior;
}

class PriorTermsOfHalf : public test::PulledTongue {
 protected:
  InferWorkspace all{m};
};

TEST_F(PriorTermsOfHalf, EveryTermAddsTheRowsAndBoundsOfTheWhole) {
  Prior{}.each([&]<class Term>(const Term&) {
    SCOPED_TRACE(typeid(Term).name());
    const Prior prior = with_example<Term>();
    TongueState* half = all.half(prior);
    ASSERT_TRUE(half);
    const Prior of_half = half_prior(prior);
    const auto unknowns = unknowns_of(m, prior, true),
               half_unknowns = unknowns_of(*half->model, of_half, true);
    ASSERT_EQ(unknowns.size(), half_unknowns.size());
    for (size_t i = 0; i < unknowns.size(); ++i) {
      EXPECT_EQ(unknowns[i].name, half_unknowns[i].name);
      const bool force = unknowns[i].kind == Unknown::Kind::muscle;
      EXPECT_NEAR((force ? 2 : 1) * half_unknowns[i].scale, unknowns[i].scale,
                  1e-12 * unknowns[i].scale);
    }
    const PriorTerms whole = prior_terms(prior, unknowns),
                     other = prior_terms(of_half, half_unknowns);
    ASSERT_EQ(whole.rows.rows(), other.rows.rows());
    EXPECT_LT((whole.rows - other.rows).norm(), 1e-12 * whole.rows.norm());
    EXPECT_LT((whole.values - other.values).norm(), 1e-12 * (1 + whole.values.norm()));
    EXPECT_LT((whole.lower - other.lower).norm(), 1e-12);
    EXPECT_LT((whole.upper - other.upper).norm(), 1e-12);
  });
}

TEST_F(PriorTermsOfHalf, EveryTermHasTheHalfAnswerOfTheWhole) {
  const Target t = pulled({{"GGP", 3}, {"TRANS", 2}, {"HG", 1}});
  Prior{}.each([&]<class Term>(const Term&) {
    SCOPED_TRACE(typeid(Term).name());
    const Prior prior = with_example<Term>();
    ASSERT_TRUE(fits_half_tongue(t, prior, {}));
    const Answer half = infer_from_starts(m, t, prior, all, {}, {1});
    ASSERT_EQ(half.status, InferStatus::converged) << half.message;
    InferOptions from_half;
    start_from(half, from_half);
    const Answer whole = infer(m, t, prior, ws, from_half);
    ASSERT_EQ(whole.status, InferStatus::converged) << whole.message;
    ASSERT_EQ(half.muscles.size(), whole.muscles.size());
    for (size_t i = 0; i < half.muscles.size(); ++i) {
      const auto &a = half.muscles[i], &b = whole.muscles[i];
      EXPECT_NEAR(a.best, b.best, 0.05 * b.sd + 1e-3 * b.maximum) << a.name;
      EXPECT_NEAR(a.sd, b.sd, 0.15 * b.sd) << a.name;  // the noise of thousands of samples
      EXPECT_EQ(a.fixed, b.fixed);
    }
    ASSERT_EQ(half.others.size(), whole.others.size());
    for (size_t i = 0; i < half.others.size(); ++i)
      EXPECT_NEAR(half.others[i].best, whole.others[i].best, 0.05 * whole.others[i].sd);
  });
}

TEST_F(PriorTermsOfHalf, ANameOfOneSideKeepsTheWholeTongue) {
  const Target t = curve_target(m, m.rest, 30, 1e-3);
  const auto fits = [&](auto set) {
    Prior prior;
    set(prior);
    return fits_half_tongue(t, prior, {});
  };
  EXPECT_FALSE(fits([](Prior& p) { p.emg["GGP_L"] = {0.2, 0.05}; }));
  EXPECT_FALSE(fits([](Prior& p) { p.fixed["GGP_R"] = 1; }));
  EXPECT_FALSE(fits([](Prior& p) { p.parameters["weak_muscle.GGP_L"] = {{1, 0.1}}; }));
  EXPECT_TRUE(fits([](Prior& p) { p.emg["GGP"] = {0.2, 0.05}; }));
}

TEST(HalfAnswers, ForcesOfMusclesAreDoubledAndParametersInNewtonsAreNot) {
  std::vector<Estimate> estimates(2);
  estimates[0].best = estimates[1].best = 3;
  estimates[1].kind = Unknown::Kind::parameter;
  double_forces(estimates);
  EXPECT_EQ(estimates[0].best, 6);
  EXPECT_EQ(estimates[1].best, 3);
}

TEST_F(PriorTermsOfHalf, EveryTermIsReadUnderKeysOfItsOwn) {
  std::vector<std::string> keys;
  Prior{}.each([&]<class Term>(const Term&) {
    for (const std::string& key : Term::keys()) keys.push_back(key);
  });
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
  EXPECT_FALSE(keys.empty());
}

/// What forgets its half-tongue map is no term, and SumOfTerms takes nothing else.
struct Forgetful {
  void add_rows(const std::vector<Unknown>&, PriorRows&) const {}
  std::vector<std::string> names() const { return {}; }
  static std::vector<std::string> keys() { return {}; }
  static Forgetful read(const TomlReader&) { return {}; }
};
static_assert(!PriorTerm<Forgetful>);
static_assert(PriorTerm<EffortTerm>);

}  // namespace
}  // namespace genio
