// The derivative of a motion is that of the steps it took.

#include "forward/motion/motion_sensitivity.hpp"

#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

/// A small tongue that is viscous, touches, and has muscles whose force falls with speed.
Model moving_model() {
  ModelDescription d = test::small_block();
  d.effects["elasticity"] = {{"a10", 1037}, {"a20", 486}, {"kappa", 1e6}};
  d.effects["palate_contact"] = {{"stiffness", 1e6}, {"damping", 8}};
  d.effects["viscosity"] = {{"alpha", 40}, {"beta", 0.01}};
  d.effects["force_velocity"] = {{"strength", 0.8}, {"max_velocity", 4}};
  d.effects["force_length"] = {{"strength", 0.7}, {"width", 0.5}, {"optimum", 1.1}};
  return build_model(d, "block");
}

TEST(MotionSensitivity, IsTheDerivativeOfTheMotion) {
  const Model m = moving_model();
  Workspace ws(m), own(m);
  Controls controls;
  for (const char* name : {"GGP_L", "GGP_R"})
    controls.combinations.push_back({{command_parameters(m, name)[0], 0.1}});
  controls.knots = {0, 0.01, 0.02, 0.03};
  TimeOptions options;
  options.duration = 0.03, options.step = 0.002, options.tolerance = 1e-10;
  Parameters base = default_parameters(m);
  const Positions start = m.rest;
  const auto at_rest = solve_equilibrium(m, base, start, ws);
  ASSERT_TRUE(at_rest) << at_rest.message;
  Vector u(8);
  u << 0, 0, 0.4, 0.2, 0.9, 0.1, 0.3, 0.6;
  const std::vector<double> when = {0.0105, 0.02, 0.03};
  const auto motion = [&](const Vector& values) {
    const Trajectory t = simulate(m, controls.over_time(values, base), at_rest.x, ws, options);
    EXPECT_TRUE(t) << t.message;
    return t;
  };
  const Trajectory t = motion(u);
  const auto exact = motion_sensitivity(m, controls, controls.over_time(u, base), t, options.scheme,
                                        {}, when, own, 1e-12);
  ASSERT_EQ(exact.size(), when.size());
  for (Eigen::Index k = 2; k < u.size(); ++k) {
    double best = 1;
    std::vector<double> errors;
    for (double h : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      const Vector e = h * Vector::Unit(u.size(), k);
      const Trajectory up = motion(u + e), down = motion(u - e);
      double error = 0, size = 0;
      for (size_t i = 0; i < when.size(); ++i) {
        const Vector q = (shape_at(up, when[i]) - shape_at(down, when[i])) / (2 * h);
        error += (q - exact[i].col(k)).squaredNorm(), size += exact[i].col(k).squaredNorm();
      }
      errors.push_back(std::sqrt(error / size));
      best = std::min(best, errors.back());
    }
    EXPECT_LT(best, 1e-6) << k;
    EXPECT_GT(errors.front(), 3 * best) << k;
  }
  // What comes later has no say.
  EXPECT_EQ(exact[0].rightCols(2).norm(), 0);
  EXPECT_GT(exact[0].col(4).norm(), 0);
}

// A damped contact that the tongue hits adds more to the tangent than what is factorised. Its
// iteration once grew by a factor of ten a step, up to 10^34, in silence.
TEST(MotionSensitivity, HoldsWhereTheTongueHitsABone) {
  ModelDescription d = test::small_block();
  d.effects["elasticity"] = {{"a10", 1037}, {"a20", 486}, {"kappa", 1e6}};
  d.effects["palate_contact"] = {{"stiffness", 3e6}, {"damping", 60}};
  d.effects["viscosity"] = {{"alpha", 10}, {"beta", 0.002}};
  const Model m = build_model(d, "block");
  Workspace ws(m), own(m);
  Controls controls{
      {{{command_parameters(m, "GGP_L")[0], 1.0}, {command_parameters(m, "GGP_R")[0], 1.0}}},
      {0, 0.004, 0.03}};
  TimeOptions options;
  options.duration = 0.03, options.step = 0.001, options.tolerance = 1e-10;
  const Parameters base = default_parameters(m);
  const auto at_rest = solve_equilibrium(m, base, m.rest, ws);
  ASSERT_TRUE(at_rest) << at_rest.message;
  const auto motion = [&](const Vector& values) {
    return simulate(m, controls.over_time(values, base), at_rest.x, ws, options);
  };
  Vector u(3);
  u << 0, 4, 4;
  const Trajectory t = motion(u);
  ASSERT_TRUE(t) << t.message;
  double deepest = 0;
  for (const Instant& i : t.instants) deepest = std::max(deepest, max_penetration(m, i.x, base));
  ASSERT_GT(deepest, 1e-5) << "it touches nothing";
  const auto exact = motion_sensitivity(m, controls, controls.over_time(u, base), t, options.scheme,
                                        {}, {0.03}, own, 1e-10);
  ASSERT_EQ(exact.size(), 1u);
  double best = 1;
  for (double h : {1e-4, 1e-5}) {
    const Vector e = h * Vector::Unit(3, 2);
    const Vector q = (motion(u + e).instants.back().x - motion(u - e).instants.back().x) / (2 * h);
    best = std::min(best, (q - exact[0].col(2)).norm() / exact[0].col(2).norm());
  }
  EXPECT_LT(best, 1e-5);
}

TEST(MotionSensitivity, ForcesThatLagAreRefused) {
  const Model m = build_model(test::with_every_effect(), "block");
  Workspace ws(m);
  Controls controls{{{{command_parameters(m, "GGP_L")[0], 1.0}}}, {0, 0.01}};
  const CommandsOverTime c = controls.over_time(Vector::Zero(2), default_parameters(m));
  EXPECT_THROW(motion_sensitivity(m, controls, c, {}, TimeScheme::newmark(), {}, {0.01}, ws),
               InputError);
}

}  // namespace
}  // namespace genio
