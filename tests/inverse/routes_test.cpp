// Different routes lead to the same optimum.

#include <gtest/gtest.h>

#include "forward/base/elapsed.hpp"
#include "inverse/search/full_space.hpp"
#include "inverse/search/global_starts.hpp"
#include "inverse/shape/objective.hpp"
#include "inverse/target/comparison.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class Routes : public test::PulledTongue {
 protected:
  InferWorkspace all{m};
};

TEST_F(Routes, FullSpaceMeetsTheReducedOptimum) {
  Target t = pulled({{"GGP", 3}, {"SL", 1}, {"HG", 1}});
  for (auto& p : t.curve) p.position += Vec2(3e-4, 8e-4);  // a misfit stays
  t.flesh.push_back(
      {{{m.landmarks.tip, 1.0}}, node_position(m.rest, m.landmarks.tip), 2e-3, "tip"});
  InferOptions full;
  full.full_space = true;
  const Answer a = infer_from_starts(m, t, Prior{}, all, {}, {1}),
               b = infer_from_starts(m, t, Prior{}, all, full, {1});
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  ASSERT_EQ(b.status, InferStatus::converged) << b.message;
  ASSERT_EQ(a.muscles.size(), b.muscles.size());
  for (size_t i = 0; i < a.muscles.size(); ++i) {
    EXPECT_NEAR(a.muscles[i].best, b.muscles[i].best, 0.02 * a.muscles[i].sd + 1e-4)
        << a.muscles[i].name;
    EXPECT_NEAR(a.muscles[i].sd, b.muscles[i].sd, 0.05 * a.muscles[i].sd);
  }
  EXPECT_NEAR(a.rms, b.rms, 1e-6);
  EXPECT_LT((a.shape - b.shape).cwiseAbs().maxCoeff(), 2e-5);
}

TEST_F(Routes, HeadPoseAndNoiseWithTailsAreTheSameInFullSpace) {
  Target t = pulled({{"GGP", 3}});
  for (auto& p : t.curve) p.position += Vec2(1e-3, -5e-4);
  t.outlier_dof = 4;
  Prior prior;
  prior.head_pose = HeadPosePrior{1e-3, 0.02};
  InferOptions full;
  full.full_space = true;
  const Answer a = infer_from_starts(m, t, prior, all, {}, {1}),
               b = infer_from_starts(m, t, prior, all, full, {1});
  ASSERT_EQ(b.status, InferStatus::converged) << b.message;
  for (size_t i = 0; i < a.others.size(); ++i)
    EXPECT_NEAR(a.others[i].best, b.others[i].best, 0.05 * a.others[i].sd);
}

TEST_F(Routes, TheLocalProblemIsTheObjectiveToSecondOrder) {
  Target t = pulled({{"GGP", 2}, {"HG", 1}});
  for (auto& p : t.curve) p.position += Vec2(1e-3, 3e-3);
  const Comparison comparison(m, t);
  const InferOptions options;
  Objective o(m, comparison, Prior{}, options, ws);
  // At the optimum its curvature counts.
  const DescentResult r = descend(o, Vector::Constant(Eigen::Index(o.unknowns().size()), 0.01), {});
  ASSERT_TRUE(r.converged) << r.message;
  const auto local = o.local(r.u);
  ASSERT_TRUE(local);
  Vector way = Vector::Random(r.u.size()).cwiseAbs();
  double last = 0;
  for (double h : {4e-3, 2e-3}) {
    double foretold = 0;
    local->value(r.u + h * way, foretold);
    const double error = std::abs(foretold - *o.value(r.u + h * way));
    EXPECT_LT(error, 0.05 * std::abs(foretold - r.value) + 1e-6);
    if (last > 0) {
      EXPECT_LT(error, 0.25 * last + 1e-7);  // third order
    }
    last = error;
  }
}

TEST_F(Routes, AtlasShapesPassThroughTheirEntriesWithTheirSlopes) {
  TongueState& tongue = *all.half(Prior{});
  const Atlas& atlas = tongue.atlas.get(*tongue.model, Prior{}, true, tongue.workspace);
  const AtlasShape shape(atlas);
  for (size_t k : {size_t(0), size_t(2), atlas.entries.size() - 1}) {
    const auto& e = atlas.entries[k];
    EXPECT_LT((shape(e.unknowns) - e.shape).cwiseAbs().maxCoeff(), 1e-12);
  }
  const auto n = Eigen::Index(atlas.names.size());
  const Vector z = Vector::Constant(n, 0.1);
  const Matrix d = shape.derivative(z);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector e = 1e-6 * Vector::Unit(n, i);
    EXPECT_LT(((shape(z + e) - shape(z - e)) / 2e-6 - d.col(i)).norm(), 1e-6 * d.col(i).norm());
  }
}

TEST_F(Routes, ValleysHoldTheTruthAmongTheDeepest) {
  const Target t = pulled({{"SL", 4}, {"HG", 3}});
  TongueState& tongue = *all.half(Prior{});
  const auto unknowns = unknowns_of(*tongue.model, Prior{}, true);
  const PriorTerms prior = prior_terms(Prior{}, unknowns);
  const Atlas& atlas = tongue.atlas.get(*tongue.model, Prior{}, true, tongue.workspace);
  const Comparison comparison(*tongue.model, half_target(all.mirror(), t));
  const auto found = valleys(atlas, comparison, unknowns, prior, 4);
  ASSERT_GE(found.size(), 2u);
  const auto value = [&](const Atlas::Entry& e) {
    return 0.5 * comparison(e.shape).values.squaredNorm() + prior.value(e.unknowns);
  };
  EXPECT_LT(value(found[0]), value(*nearest(atlas, comparison, unknowns, prior).front()));
  for (size_t k = 1; k < found.size(); ++k) {
    EXPECT_GE(value(found[k]), value(found[k - 1]) - 1e-9);
    EXPECT_GT((found[k].unknowns - found[0].unknowns).cwiseAbs().maxCoeff(), 0.05);
  }
}

TEST_F(Routes, AnAtlasIsMadeOnceForEachSetOfUnknownsAlsoInParts) {
  TongueState& tongue = *all.half(Prior{});
  const auto made = [&](const Prior& prior, const StopAtlas& stop = {}) {
    const Stopwatch watch;
    const size_t entries =
        tongue.atlas.get(*tongue.model, prior, true, tongue.workspace, stop).entries.size();
    return std::pair(entries, watch.seconds());
  };
  Prior fixed;
  fixed.fixed["GGP"] = 1;
  int asked = 0;
  const auto stopped = made(Prior{}, [&] { return ++asked > 3; });
  EXPECT_LT(stopped.first, 6u);
  const Atlas whole = make_atlas(*tongue.model, Prior{}, true, tongue.workspace);
  const auto first = made(Prior{});
  ASSERT_EQ(first.first, whole.entries.size());
  const Atlas& parts = tongue.atlas.get(*tongue.model, Prior{}, true, tongue.workspace);
  for (size_t k = 0; k < whole.entries.size(); ++k)
    EXPECT_LT((parts.entries[k].shape - whole.entries[k].shape).cwiseAbs().maxCoeff(), 1e-9);
  const auto other = made(fixed), again = made(Prior{});
  EXPECT_GT(first.first, stopped.first);
  EXPECT_LT(other.first, first.first);
  EXPECT_EQ(again.first, first.first);
  EXPECT_LT(again.second, 0.1 * first.second);
}

}  // namespace
}  // namespace genio
