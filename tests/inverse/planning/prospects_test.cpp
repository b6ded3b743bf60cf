#include "inverse/planning/prospects.hpp"

#include <random>

#include "inverse/planning/further_measurements.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class WhatToMeasure : public test::PulledTongue {
 protected:
  Answer answered(const Target& target) {
    const Answer a = infer(m, target, Prior{}, ws, options);
    EXPECT_EQ(a.status, InferStatus::converged) << a.message;
    return a;
  }
  Prospects expected(const Target& target, const Answer& a, const std::vector<std::string>& texts,
                     int draws = 4) {
    std::vector<FurtherMeasurement> candidates;
    for (const auto& text : texts)
      candidates.push_back(further_measurement(m, target, a.shape, text));
    return prospects(m, target, Prior{}, a, candidates, ws, options, {draws, {}});
  }
  InferOptions options = [] {
    InferOptions o;
    o.bilateral = true;
    return o;
  }();
};

double all_widths(const Prospects& p, const std::vector<Doubt>& doubts) {
  double sum = 0;
  for (size_t k = 0; k < doubts.size(); ++k) sum += doubts[k].width / p.maximum[k];
  return sum;
}

TEST_F(WhatToMeasure, MoreOfAMeasurementTellsMore) {
  Target front = pulled({{"GGP", 2}, {"TRANS", 1}});
  front.curve.resize(16);  // the tip alone
  const Answer a = answered(front);
  const Prospects p = expected(front, a, {"contour=dorsum", "contour", "contour@0.1mm"});
  EXPECT_GT(p.further[0].gain, 0);
  EXPECT_GT(p.further[1].gain, p.further[0].gain);
  EXPECT_GT(p.further[2].gain, p.further[1].gain);
  EXPECT_GT(p.further[1].values, p.further[0].values);
  EXPECT_NEAR(p.further[1].gain, 1 - all_widths(p, p.further[1].muscles) / all_widths(p, p.before),
              1e-9);
}

TEST_F(WhatToMeasure, AnEmgWithoutErrorLeavesNothingOpenOfItsMuscle) {
  const Target t = pulled({{"GGP", 2}, {"TRANS", 1}});
  const Answer a = answered(t);
  const Prospects p = expected(t, a, {"emg=TRANS@0.001", "emg=TRANS@10"});
  const size_t trans =
      size_t(std::find(p.muscles.begin(), p.muscles.end(), "TRANS") - p.muscles.begin());
  EXPECT_LT(p.further[0].muscles[trans].width, 0.01 * p.maximum[trans]);
  EXPECT_GT(p.before[trans].width, 0.02 * p.maximum[trans]);
}

// What is expected by simulation on the derivative is what comes out when it is measured.
TEST_F(WhatToMeasure, TheExpectedWidthIsThatOfTheMeasurementOnceItIsMade) {
  Target few = pulled({{"GGP", 2}, {"HG", 0.5}});
  few.curve.resize(20);
  const Answer a = answered(few);
  const Prospects p = expected(few, a, {"contour"}, 12);
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 5e-4);
  std::vector<Doubt> made(p.muscles.size());
  constexpr int times = 6;
  for (int k = 0; k < times; ++k) {
    Target whole = few;
    for (CurvePoint q : further_measurement(m, few, a.shape, "contour").points.curve) {
      q.position += Vec2(normal(random), normal(random));
      whole.curve.push_back(q);
    }
    const Answer then = answered(whole);
    for (size_t i = 0; i < made.size(); ++i)
      made[i].width += (then.muscles[i].high - then.muscles[i].low) / times;
  }
  const double before = all_widths(p, p.before), after = all_widths(p, p.further[0].muscles),
               found = all_widths(p, made);
  EXPECT_LT(found, 0.9 * before);
  EXPECT_NEAR(after / found, 1, 0.35) << before << " " << after << " " << found;
}

TEST_F(WhatToMeasure, IsTheSameEveryTime) {
  const Target t = pulled({{"GGP", 2}});
  const Answer a = answered(t);
  const Prospects one = expected(t, a, {"slice=dorsum"}), two = expected(t, a, {"slice=dorsum"});
  EXPECT_EQ(one.further[0].widths, two.further[0].widths);
}

TEST_F(WhatToMeasure, WhatIsNotEstimatedIsRefused) {
  const Target t = pulled({{"GGP", 2}});
  const Answer a = answered(t);
  EXPECT_THROW(expected(t, a, {"emg=GGX"}), InputError);
  EXPECT_THROW(expected(t, a, {"parameter=jaw_opening.angle@0.01"}), InputError);
}

}  // namespace
}  // namespace genio
