// Motion: order in time, energy, waves, damping, contact, commands.

#include "forward/motion/dynamics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "bench/problems/problems.hpp"
#include "bench/problems/traction.hpp"
#include "forward/geometry/box_mesh.hpp"
#include "forward/model/build_model.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

ModelDescription free_block(double alpha, double beta) {
  ModelDescription d = test::small_block();
  d.effects.erase("palate_contact");
  d.effects["gravity"] = {{"x", 3}, {"y", 1}, {"z", -9.81}};
  if (alpha > 0 || beta > 0) d.effects["viscosity"] = {{"alpha", alpha}, {"beta", beta}};
  return d;
}

Trajectory moved(const Model& m, const CommandsOverTime& c, const TimeOptions& o) {
  Workspace ws(m);
  return simulate(m, c, m.rest, ws, o);
}

/// Commands that start smoothly, so that order is not lost to the start.
CommandsOverTime swelling(const Model& m) {
  CommandsOverTime c;
  const Parameters full = default_parameters(m);
  for (int i = 0; i <= 400; ++i) {
    const double t = 1e-4 * i, s = std::sin(std::numbers::pi / 2 * i / 400.0);
    Parameters p = full;
    for (size_t k = 0; k < m.parameters.size(); ++k)
      if (m.parameters[k].info.load) p[Eigen::Index(k)] *= s * s * s * s;
    set_command(m, "GGP_L", 0.05 * s * s * s * s, p);
    c.times.push_back(t), c.values.push_back(p);
  }
  return c;
}

TEST(Dynamics, ProgressGrowsToTheWholeMotion) {
  const Model m = build_model(free_block(40, 2e-3), "block");
  std::vector<double> heard;
  TimeOptions o;
  o.duration = 0.01, o.step = 2e-3;
  o.progress = [&](double part) { heard.push_back(part); };
  ASSERT_TRUE(moved(m, swelling(m), o));
  ASSERT_EQ(heard.size(), 5u);
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  EXPECT_DOUBLE_EQ(heard.back(), 1);
}

TEST(Dynamics, IsOfSecondOrderInTime) {
  const Model m = build_model(free_block(40, 2e-3), "block");
  const CommandsOverTime c = swelling(m);
  for (const auto& scheme : {TimeScheme::newmark(), TimeScheme::generalised_alpha(0.5)}) {
    const auto end = [&](double step) {
      TimeOptions o;
      o.duration = 0.04, o.step = step, o.scheme = scheme, o.tolerance = 1e-10;
      const Trajectory t = moved(m, c, o);
      EXPECT_TRUE(t) << t.message;
      return t.instants.back().x;
    };
    const Positions exact = end(1.25e-4);
    const double coarse = (end(2e-3) - exact).norm(), fine = (end(1e-3) - exact).norm();
    EXPECT_GT(std::log2(coarse / fine), 1.9);
  }
}

TEST(Dynamics, UndampedEnergyStaysWithinAThousandth) {
  const Model m = build_model(free_block(0, 0), "block");
  TimeOptions o;
  o.duration = 0.1, o.step = 2e-4, o.scheme = TimeScheme::newmark(), o.tolerance = 1e-9;
  const Parameters p = default_parameters(m);
  const Trajectory t = moved(m, ramp(p, p, 0), o);  // let go in mid-air
  ASSERT_TRUE(t) << t.message;
  const double first = t.instants.front().potential;
  double exchanged = 0, worst = 0;
  for (const Instant& i : t.instants) {
    exchanged = std::max(exchanged, i.kinetic);
    worst = std::max(worst, std::abs(i.kinetic + i.potential - first));
    EXPECT_EQ(i.dissipated, 0);
  }
  EXPECT_LT(worst, 1e-3 * exchanged);
}

TEST(Dynamics, WorkBecomesEnergyAndHeat) {
  const Model m = build_model(free_block(40, 2e-3), "block");
  TimeOptions o;
  o.duration = 0.04, o.step = 2.5e-4, o.tolerance = 1e-9;
  const Trajectory t = moved(m, swelling(m), o);
  ASSERT_TRUE(t) << t.message;
  const Instant &first = t.instants.front(), &last = t.instants.back();
  EXPECT_GT(last.dissipated, 0);
  EXPECT_NEAR(last.kinetic + last.potential + last.dissipated - first.potential, last.work_done,
              2e-3 * std::abs(last.work_done));
}

/// A slender bar, drawn out and let go: its end over time [m].
struct Bar {
  static constexpr double length = 0.09, width = 0.003;
  std::vector<double> time, end;

  static Model model(double alpha, double beta) {
    HexMesh mesh = box_mesh(Vec3(length, width, width), {30, 1, 1});
    std::vector<Support> supports;
    for (const Vec3& x : mesh.nodes)  // clamped where it may still thin: a bar without ends
      supports.push_back(held_along(x[0] < 1e-9, x[1] < 1e-9, x[2] < 1e-9));
    Forces load = Forces::Zero(Eigen::Index(3 * mesh.nodes.size()));
    Mat3 pull = Mat3::Zero();
    pull(0, 0) = 1;
    bench::add_traction(
        mesh, pull, [](const Vec3& x) { return x[0] > length - 1e-9; }, load);
    // 0.16 %
    return bench::damped(bench::tissue_problem(mesh, supports, {1037, 486, 1037e3}, load, 10),
                         alpha, beta);
  }

  Bar(double alpha, double beta, double duration) {
    const Model m = model(alpha, beta);
    Workspace ws(m);
    Parameters p = default_parameters(m);
    const auto drawn = solve_equilibrium(m, p, m.rest, ws);
    EXPECT_TRUE(drawn) << drawn.message;
    p[parameter_index(m, "load.force")] = 0;
    TimeOptions o;
    o.duration = duration, o.step = 1e-3, o.scheme = TimeScheme::newmark();
    const Trajectory t = simulate(m, ramp(p, p, 0), drawn.x, ws, o);
    EXPECT_TRUE(t) << t.message;
    for (const Instant& i : t.instants)
      time.push_back(i.time), end.push_back(i.x.maxCoeff() - length);
  }
  /// Times at which the end passes its rest place.
  std::vector<double> crossings() const {
    std::vector<double> c;
    for (size_t i = 1; i < end.size(); ++i)
      if (end[i - 1] * end[i] < 0)
        c.push_back(time[i - 1] + (time[i] - time[i - 1]) * end[i - 1] / (end[i - 1] - end[i]));
    return c;
  }
};

TEST(Dynamics, ClampedBarRingsAtItsFrequency) {
  const Bar bar(0, 0, 1.0);
  const auto c = bar.crossings();
  ASSERT_GT(c.size(), 6u);
  const double frequency = 0.5 * double(c.size() - 1) / (c.back() - c.front());
  const double young = 6 * 1037;
  EXPECT_NEAR(frequency, std::sqrt(young / 1040) / (4 * Bar::length), 0.01 * frequency);
}

TEST(Dynamics, RayleighDampingDecaysAtItsRate) {
  const double w = 2 * std::numbers::pi * std::sqrt(6 * 1037 / 1040.0) / (4 * Bar::length);
  for (const auto& [alpha, beta] : {std::pair{3.0, 0.0}, {0.0, 2e-3}}) {
    const Bar bar(alpha, beta, 0.8);
    const auto c = bar.crossings();
    ASSERT_GT(c.size(), 5u);
    const auto peak_between = [&](size_t k) {
      double peak = 0;
      for (size_t i = 0; i < bar.time.size(); ++i)
        if (bar.time[i] > c[k] && bar.time[i] < c[k + 1])
          peak = std::max(peak, std::abs(bar.end[i]));
      return peak;
    };
    const size_t last = c.size() - 2;
    const double rate = std::log(peak_between(1) / peak_between(last)) / (c[last] - c[1]);
    EXPECT_NEAR(rate, 0.5 * (alpha + beta * w * w), 0.05 * rate);  // zeta w
  }
}

TEST(Dynamics, DampedContactStopsTheTongueWithinATenthOfAMillimetre) {
  ModelDescription d = free_block(40, 0.01);
  d.effects["elasticity"]["kappa"] = 192000;
  d.effects["palate_contact"] = {{"stiffness", 2e8}, {"damping", 5}};
  d.effects["gravity"] = {{"x", 0}, {"y", 0}, {"z", 19}};  // falls upwards
  const Model m = build_model(d, "block");
  TimeOptions o;
  o.duration = 0.1;
  const Parameters p = default_parameters(m);
  const Trajectory t = moved(m, ramp(p, p, 0), o);
  ASSERT_TRUE(t) << t.message;
  const auto& touch = m.contacts[0];
  EXPECT_GT(touch->energy(t.instants.back().x, touch.values(p)), 0);
  EXPECT_LT(t.max_penetration, 1e-4);
}

TEST(Dynamics, ComesToRestAtTheStaticEquilibrium) {
  const Model m = build_model(free_block(40, 0.03), "block");
  Workspace ws(m);
  const Parameters p = default_parameters(m);
  TimeOptions o;
  o.duration = 2, o.step = 0.02;
  const Trajectory t = moved(m, ramp(p, p, 0), o);
  ASSERT_TRUE(t) << t.message;
  const auto still = solve_equilibrium(m, p, m.rest, ws);
  EXPECT_LT((t.instants.back().x - still.x).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Dynamics, AdaptiveStepsKeepTheirAccuracy) {
  const Model m = build_model(free_block(40, 2e-3), "block");
  const CommandsOverTime c = swelling(m);
  TimeOptions fine;
  fine.duration = 0.04, fine.step = 1e-4;
  TimeOptions adaptive = fine;
  adaptive.step = 0.01, adaptive.accuracy = 1e-6;
  const Trajectory a = moved(m, c, adaptive), f = moved(m, c, fine);
  ASSERT_TRUE(a) << a.message;
  EXPECT_LT(a.instants.size(), f.instants.size() / 2);
  EXPECT_LT((a.instants.back().x - f.instants.back().x).cwiseAbs().maxCoeff(), 5e-6);
}

TEST(CommandsOverTime, ActivationFollowsExcitationWithItsTimeConstants) {
  ModelDescription d = free_block(40, 0.01);
  d.effects["activation_dynamics"] = {{"rise", 0.01}, {"fall", 0.03}};
  const Model m = build_model(d, "block");
  Parameters off = default_parameters(m), on = off;
  set_command(m, "GGP_L", 1, on);
  const int k = parameter_index(m, "muscles.GGP_L");
  const CommandsOverTime a = activated(m, {{0, 0.05, 0.05}, {on, on, off}});
  EXPECT_NEAR(a.at(0.02)[k], 1 - std::exp(-2.0), 1e-3);
  EXPECT_NEAR(a.at(0.08)[k], (1 - std::exp(-5.0)) * std::exp(-1.0), 1e-2);
}

TEST(CommandsOverTime, FilesWithFaultsSayWhere) {
  const Model m = test::small_model();
  const std::string path = testing::TempDir() + "commands.csv";
  const auto complaint = [&](const std::string& text) -> std::string {
    std::ofstream(path) << text;
    try {
      read_commands(m, path, default_parameters(m));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("time_s,GGP_L_N\n0,0\n0.1,1\n"), "");
  EXPECT_NE(complaint("GGP_L\n0\n").find(":1: expected a header"), std::string::npos);
  EXPECT_NE(complaint("time_s,GGP_L\n0,x\n").find(":2: column GGP_L: 'x'"), std::string::npos);
  EXPECT_NE(complaint("time_s,GGP_L\n0\n").find(":2: 1 columns"), std::string::npos);
  EXPECT_NE(complaint("time_s,GGP_L\n1,0\n0,0\n").find("rising times"), std::string::npos);
  EXPECT_NE(complaint("time_s,GPG\n0,0\n").find("did you mean"), std::string::npos);
  EXPECT_NE(complaint("time_s,GGP_L\n0,99\n").find("above the muscle"), std::string::npos);
}

}  // namespace
}  // namespace genio
