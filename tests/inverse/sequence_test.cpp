// A recording as one problem: smoothing, and a movement with inertia.

#include "inverse/sequence/sequence.hpp"

#include <gtest/gtest.h>

#include <random>

#include "inverse/sequence/motion_inversion.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class Sequence : public test::PulledTongue {
 protected:
  /// Noisy lines under GGP rising slowly, 10 ms apart.
  std::vector<SequenceFrame> rising(int count, double noise) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::vector<SequenceFrame> frames;
    for (int k = 0; k < count; ++k) {
      frames.push_back({pulled({{"GGP", 2 + 0.1 * k}}, 20, noise), 0.01 * k});
      for (auto& p : frames.back().target.curve)
        p.position += noise * Vec2(normal(random), normal(random));
    }
    return frames;
  }
  static double force(const Answer& a, const std::string& name) {
    for (const auto& c : a.muscles)
      if (c.name == name) return c.best;
    return -1;
  }
  static double sd(const Answer& a, const std::string& name) {
    for (const auto& c : a.muscles)
      if (c.name == name) return c.sd;
    return -1;
  }
  InferWorkspace all{m};
};

TEST_F(Sequence, SmoothingTakesNoiseAwayAndKnowsIt) {
  const auto frames = rising(6, 1.5e-3);
  Prior prior;
  prior.smoothness_sd = 0.1;  // 1 % of maximum a frame
  const auto smooth = infer_sequence(m, frames, prior, all);
  double rough_steps = 0, smooth_steps = 0;
  std::vector<Answer> single;
  for (const auto& f : frames) single.push_back(infer_from_starts(m, f.target, prior, all));
  for (size_t k = 0; k < frames.size(); ++k) {
    ASSERT_EQ(smooth[k].status, InferStatus::converged) << smooth[k].message;
    EXPECT_LT(sd(smooth[k], "GGP"), sd(single[k], "GGP"));
    if (k == 0) continue;
    rough_steps += std::pow(force(single[k], "GGP") - force(single[k - 1], "GGP"), 2);
    smooth_steps += std::pow(force(smooth[k], "GGP") - force(smooth[k - 1], "GGP"), 2);
  }
  EXPECT_LT(smooth_steps, rough_steps);
}

TEST_F(Sequence, AWalkThatCannotWalkHasOneAnswer) {
  const auto frames = rising(3, 1e-3);
  Prior prior;
  prior.smoothness_sd = 1e-3;
  SequenceOptions options;
  options.threads = 2;
  const auto a = infer_sequence(m, frames, prior, all, options);
  for (const Answer& answer : a) {
    ASSERT_EQ(answer.status, InferStatus::converged) << answer.message;
    EXPECT_NEAR(force(answer, "GGP"), force(a[0], "GGP"), 0.02);
  }
}

TEST_F(Sequence, TakesUpACheckpointAndSkipsEmptyFrames) {
  auto frames = rising(3, 1e-3);
  std::vector<Vector> kept;
  SequenceOptions options;
  options.checkpoint = [&](const std::vector<Vector>& z) { kept = z; };
  const auto whole = infer_sequence(m, frames, Prior{}, all, options);
  ASSERT_EQ(kept.size(), 3u);
  SequenceOptions again;
  again.known = kept;
  const auto resumed = infer_sequence(m, frames, Prior{}, all, again);
  for (size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(resumed[k].status, InferStatus::converged) << resumed[k].message;
    EXPECT_NEAR(force(resumed[k], "GGP"), force(whole[k], "GGP"), 0.05 * sd(whole[k], "GGP"));
  }
  frames[1].target = {};
  const auto gap = infer_sequence(m, frames, Prior{}, all);
  EXPECT_EQ(gap[1].status, InferStatus::failed);
  EXPECT_EQ(gap[2].status, InferStatus::converged);
}

TEST_F(Sequence, AMovementIsFoundAgain) {
  CommandsOverTime c;
  Parameters rest = default_parameters(m), there = rest;
  set_command(m, "GGP", 3, there);
  set_command(m, "SL", 0.6, there);
  c.times = {0, 0.05}, c.values = {rest, there};
  TimeOptions time;
  time.duration = 0.05, time.step = 0.005;
  const auto start = solve_equilibrium(m, rest, m.rest, ws);
  const Trajectory t = simulate(m, c, start.x, ws, time);
  ASSERT_TRUE(t) << t.message;
  std::vector<MotionFrame> frames;
  for (double when : {0.025, 0.05})
    frames.push_back({curve_target(m, shape_at(t, when), 30, 5e-4), when});
  MotionOptions options;
  options.time = time, options.knot_s = 0.025, options.from_rest = true;
  std::vector<Vector> kept;
  options.checkpoint = [&](const std::vector<Vector>& z) { kept = z; };
  const MotionAnswer a = infer_motion(m, frames, Prior{}, all, options);
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  EXPECT_EQ(a.verdict, Verdict::explained);
  EXPECT_LT(1e3 * a.rms, 0.1);
  ASSERT_EQ(a.knots_s, (std::vector<double>{0, 0.025, 0.05}));
  for (const auto& e : a.estimates[0]) EXPECT_EQ(e.best, 0);
  // Each knot says of each muscle whether it acts, and the interval of one that may rest is from 0.
  double of_resting = 0, resting = 0;
  for (const auto& e : a.estimates[2]) {
    if (e.name == "GGP") {
      EXPECT_GT(e.acts, 0.6);
      EXPECT_LE(e.low, 3);
      EXPECT_GE(e.high, 3);
    } else if (e.name != "SL") {
      of_resting += e.acts, ++resting;
      EXPECT_EQ(e.low, 0) << e.name;
    }
  }
  EXPECT_LT(of_resting / resting, 0.4);
  EXPECT_EQ(a.joint.size(), a.knots_s.size());
  // Commands in, the same motion out, on the whole tongue.
  CommandsOverTime found;
  for (size_t j = 0; j < a.knots_s.size(); ++j) {
    Parameters p = rest;
    for (const auto& e : a.estimates[j]) set_command(m, e.name, e.best, p);
    found.times.push_back(a.knots_s[j]), found.values.push_back(p);
  }
  const Trajectory again = simulate(m, found, start.x, ws, time);
  EXPECT_LT((again.instants.back().x - a.frames.back().shape).cwiseAbs().maxCoeff(), 1e-4);
  // From where an interrupted run stood it needs no more than a look.
  MotionOptions resumed = options;
  resumed.known = kept;
  const MotionAnswer b = infer_motion(m, frames, Prior{}, all, resumed);
  EXPECT_EQ(b.status, InferStatus::converged) << b.message;
  EXPECT_LT(b.simulations, a.simulations);
}

TEST_F(Sequence, MovementsWithoutTimeAreRefused) {
  MotionFrame frame{pulled({{"GGP", 2}}), 0};
  EXPECT_THROW(infer_motion(m, {frame}, Prior{}, all), InputError);
  EXPECT_THROW(infer_motion(m, {}, Prior{}, all), InputError);
  Prior pose;
  pose.head_pose = HeadPosePrior{1e-3, 0.01};
  frame.time_s = 0.1;
  EXPECT_THROW(infer_motion(m, {frame}, pose, all), InputError);
}

}  // namespace
}  // namespace genio
