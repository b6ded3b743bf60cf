#include "inverse/shape/believed.hpp"

#include <gtest/gtest.h>

#include "inverse/posterior/distributions.hpp"
#include "inverse/posterior/posterior.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class Believed : public test::PulledTongue {
 protected:
  /// A shape as it is seen of a head that is that much higher than it is said to be [m].
  Target raised(double by) {
    Target t = pulled({{"GGP", 2.8}, {"SL", 1.2}}, 40, 1e-3);
    for (CurvePoint& p : t.curve) p.position[1] += by;
    return t;
  }
  static Prior head(double shift_sd, double turn_sd) {
    Prior prior;
    prior.head_pose = HeadPosePrior{shift_sd, turn_sd};
    return prior;
  }
  /// Other muscles could make up for a part of it.
  static Prior head_and_two_muscles(double shift_sd, double turn_sd) {
    Prior prior = head(shift_sd, turn_sd);
    for (const char* muscle : {"GGM", "GGA", "STY", "HG", "VERT", "TRANS", "IL", "GH", "MH"})
      prior.fixed[muscle] = 0;
    return prior;
  }
};

TEST_F(Believed, TheTestCountsWhatIsEstimatedAlongAndNoMuscle) {
  const Prior prior = head(1e-3, 0.05);
  const auto unknowns = unknowns_of(m, prior, false);
  const PriorTerms terms = prior_terms(prior, unknowns);
  Vector z = Vector::Zero(Eigen::Index(unknowns.size()));
  EXPECT_EQ(test_beliefs(unknowns, terms, z).tail, 1);
  z[0] = 1;  // a muscle at its maximum
  EXPECT_EQ(test_beliefs(unknowns, terms, z).tail, 1);
  const Eigen::Index x = z.size() - 3, turn = z.size() - 1;
  z[x] = 0.5e-3 / unknowns[size_t(x)].scale, z[turn] = 0.15 / unknowns[size_t(turn)].scale;
  const BeliefTest test = test_beliefs(unknowns, terms, z);
  EXPECT_NEAR(test.tail, chi_square_tail(0.25 + 9, 3), 1e-12);
  EXPECT_EQ(test.worst->name, "head_pose.turn");
  EXPECT_NEAR(test.worst_sds, 3, 1e-12);
}

TEST_F(Believed, NothingEstimatedAlongIsNoDoubt) {
  const auto unknowns = unknowns_of(m, Prior{}, false);
  const Vector z = Vector::Constant(Eigen::Index(unknowns.size()), 0.5);
  EXPECT_EQ(test_beliefs(unknowns, prior_terms(Prior{}, unknowns), z).tail, 1);
}

TEST_F(Believed, AShapeThatOnlyAMovedHeadMeetsIsNotExplained) {
  const Target t = raised(0.012);
  const Answer wide = infer(m, t, head_and_two_muscles(10e-3, 0.05), ws);
  ASSERT_EQ(wide.status, InferStatus::converged) << wide.message;
  EXPECT_EQ(wide.verdict, Verdict::explained) << wide.message;
  const Answer narrow = infer(m, t, head_and_two_muscles(2e-3, 0.05), ws);
  ASSERT_EQ(narrow.status, InferStatus::converged) << narrow.message;
  EXPECT_NE(narrow.verdict, Verdict::explained) << narrow.message;
}

TEST_F(Believed, TheMessageNamesWhatIsBeyondBelief) {
  Answer a;
  a.verdict = Verdict::explained;
  const Prior prior = head(1e-3, 0.05);
  const auto unknowns = unknowns_of(m, prior, false);
  Vector z = Vector::Zero(Eigen::Index(unknowns.size()));
  const Eigen::Index turn = z.size() - 1;
  z[turn] = 0.2 / unknowns[size_t(turn)].scale;
  doubt_unbelievable(unknowns, prior_terms(prior, unknowns), z, a);
  EXPECT_EQ(a.verdict, Verdict::mismatch);
  EXPECT_NE(a.message.find("head_pose.turn 4.0 standard deviations"), std::string::npos)
      << a.message;
  a.verdict = Verdict::unreachable, a.message = "as it was";
  doubt_unbelievable(unknowns, prior_terms(prior, unknowns), z, a);
  EXPECT_EQ(a.verdict, Verdict::unreachable);
  EXPECT_EQ(a.message, "as it was");
}

}  // namespace
}  // namespace genio
