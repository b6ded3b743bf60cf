// A speaker who differs from the model along a mode of anatomy is told from other discrepancies.

#include "forward/anatomy/refined_model.hpp"
#include "forward/effects/modes/anatomy_modes.hpp"
#include "forward/model/at_anatomy.hpp"
#include "tests/discrepancy/posed_tongue.hpp"

namespace genio {
namespace {

class HiddenAnatomy : public test::PosedTongue {
 protected:
  ModelDescription with(const std::string& mode, double value) const {
    ModelDescription d = moded;
    d.effects["anatomy"][mode] = value;
    return d;
  }
  Discovery found(const ModelDescription& truth, bool correct_mesh) {
    Observations o = observed(truth, true);
    o.conditions.back().heldout = true;
    DiscoverOptions options;
    options.correct_mesh = correct_mesh, options.refits = 2, options.most_effects = 1;
    return discover(moded, o, options);
  }
  void expect_named(const Discovery& d, const std::string& mode, double value) const {
    ASSERT_FALSE(d.effects.empty()) << to_string(d.verdict) << ": " << d.message;
    EXPECT_EQ(d.effects[0].effect, "anatomy");
    EXPECT_EQ(d.effects[0].where, mode);
    ASSERT_EQ(d.effects[0].parameters.size(), 1u);
    EXPECT_NEAR(d.effects[0].parameters[0].value, value, 0.2 * std::abs(value));
    EXPECT_LT(d.heldout_after.rms, 0.5 * d.heldout_before.rms);
  }
  const ModelDescription moded = with_modes(tongue, plain_modes(tongue));
};

TEST_F(HiddenAnatomy, OfSizeIsNamedOnARefinedTongue) {
  expect_named(found(refined(with("size", 0.8)), true), "size", 0.8);
}

TEST_F(HiddenAnatomy, OfThePharynxIsNamedWithItsAmount) {
  expect_named(found(with("pharynx", -1), false), "pharynx", -1);
}

TEST_F(HiddenAnatomy, IsNotNamedWhereThereIsNone) {
  const Discovery d = found(moded, false);
  EXPECT_EQ(d.verdict, DiscoveryVerdict::none) << d.message;
  EXPECT_TRUE(d.effects.empty());
}

using ScoredAnatomy = test::FittedTongue;

TEST_F(ScoredAnatomy, SignatureIsWhatResidualsDoAsTheModeGrows) {
  const ModelDescription moded = with_modes(tongue, plain_modes(tongue));
  fit_to(tongue, moded);
  for (const Candidate& candidate : candidates(moded, observations)) {
    if (candidate.effect != "anatomy") continue;
    const Matrix s = signature(candidate, *set, f, influences);
    Eigen::Index row = 0;
    for (size_t k = 0; k < f.conditions.size(); ++k) {
      const FittedCondition& c = f.conditions[k];
      const Model& m = set->model(k);
      const Comparison comparison(m, set->condition(k).target, surface_smoothing);
      const auto at = [&](double value) -> Vector {
        Parameters p = c.parameters;
        p[parameter_index(m, "anatomy." + candidate.where)] = value;
        const auto e = solve_equilibrium(m, p, c.x, set->workspace(k), {.tolerance = 1e-11});
        EXPECT_TRUE(e) << e.message;
        return comparison(e.x).values;
      };
      const double h = 1e-4;
      const Vector here = at(0), after = (at(h) - here) / h, before = (here - at(-h)) / h;
      const Vector quotient = 0.5 * (after + before);
      // The first and the last point lie where the line ends. There the residual has a kink, and
      // the signature lies between its two slopes.
      const Eigen::Index last = quotient.size() - 1, within = quotient.size() - 2;
      for (const Eigen::Index i : {Eigen::Index(0), last}) {
        const double slack = 0.02 * (std::abs(after[i]) + std::abs(before[i]));
        EXPECT_GT(s(row + i, 0), std::min(after[i], before[i]) - slack) << candidate.where;
        EXPECT_LT(s(row + i, 0), std::max(after[i], before[i]) + slack) << candidate.where;
      }
      EXPECT_LT((quotient - s.middleRows(row, quotient.size()).col(0)).segment(1, within).norm(),
                1e-3 * quotient.segment(1, within).norm())
          << candidate.where << " condition " << k << ": " << quotient.transpose() << "\nagainst "
          << s.middleRows(row, quotient.size()).col(0).transpose();
      row += quotient.size();
    }
  }
}

}  // namespace
}  // namespace genio
