#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "forward/statics/sensitivity.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

TEST(Equilibrium, IsTheSameFromAnyStart) {
  const Model m = read_model(test::generic_model());
  Workspace ws(m);
  Parameters p = default_parameters(m);
  set_command(m, "GGP", 3, p);
  set_command(m, "HG", 1, p);
  const auto from_rest = solve_equilibrium(m, p, m.rest, ws);
  ASSERT_TRUE(from_rest) << from_rest.message;
  Parameters other = default_parameters(m);
  set_command(m, "STY", 1.5, other);
  const auto elsewhere = solve_equilibrium(m, other, m.rest, ws);
  ASSERT_TRUE(elsewhere) << elsewhere.message;
  const auto again = solve_equilibrium(m, p, elsewhere.x, ws);
  ASSERT_TRUE(again) << again.message;
  EXPECT_LT((again.x - from_rest.x).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Equilibrium, KeepsTheVolumeAndMidsagittalSymmetry) {
  const Model m = read_model(test::generic_model());
  Workspace ws(m);
  Parameters p = default_parameters(m);
  set_command(m, "GGP", 4, p);
  const auto e = solve_equilibrium(m, p, m.rest, ws);
  ASSERT_TRUE(e) << e.message;
  EXPECT_NEAR(mesh_volume(m.mesh, e.x) / mesh_volume(m.mesh, m.rest), 1, 1e-3);
  EXPECT_LT(std::abs(e.x[3 * m.landmarks.dorsum + 1]), 1e-4);
  EXPECT_LT(max_penetration(m, e.x, e.parameters), 1e-4);
}

TEST(Equilibrium, FollowsAnOpeningJawWithoutLoads) {
  ModelDescription d = read_description(test::generic_model());
  for (const double angle : {0.0, 1.0, 4.0, 12.0}) {
    d.effects["jaw_opening"] = {{"angle", angle}, {"slide", 1e-4 * angle}};
    const Model m = build_model(d, "generic");
    Workspace ws(m);
    const auto e = solve_equilibrium(m, default_parameters(m), m.rest, ws);
    ASSERT_TRUE(e) << angle << ": " << e.message;
    EXPECT_LE(e.load_steps, 2) << angle;
    if (angle == 0) {
      EXPECT_LT((e.x - m.rest).cwiseAbs().maxCoeff(), 1e-9);
      continue;
    }
    EXPECT_LT(e.x[3 * m.landmarks.tip + 2] - m.rest[3 * m.landmarks.tip + 2], -5e-4 * angle);
  }
}

TEST(Equilibrium, FailureIsAStatusWithAReason) {
  const Model m = test::small_model();
  Workspace ws(m);
  Parameters p = default_parameters(m);
  p[0] = std::numeric_limits<double>::quiet_NaN();
  const auto e = solve_equilibrium(m, p, m.rest, ws);
  EXPECT_FALSE(e);
  EXPECT_FALSE(e.message.empty());
}

TEST(Equilibrium, TissueThatSoftensWithoutEndFailsInsteadOfSearchingOn) {
  const Model m = test::small_model();
  for (const char* name : {"elasticity.a10", "elasticity.a20"}) {
    Workspace ws(m);
    Parameters p = default_parameters(m);
    p[parameter_index(m, name)] = -1e4;
    p[parameter_index(m, "muscles.GGP_L")] = 1;
    const auto e = solve_equilibrium(m, p, m.rest, ws);
    EXPECT_FALSE(e) << name;
    EXPECT_FALSE(e.message.empty());
  }
}

TEST(Sensitivity, IsTheDerivativeOfTheEquilibrium) {
  const Model m = test::small_model();
  Workspace ws(m);
  Parameters p = default_parameters(m);
  set_command(m, "GGP_L", 0.02, p);
  SolveOptions tight;
  tight.tolerance = 1e-12;
  const auto e = solve_equilibrium(m, p, m.rest, ws, tight);
  ASSERT_TRUE(e) << e.message;
  std::vector<int> all;
  for (size_t k = 0; k < m.parameters.size(); ++k) all.push_back(int(k));
  const Matrix s = sensitivity(m, e, all, ws);
  for (int k : all) {
    const double h =
        1e-5 * std::max(std::abs(p[k]), m.parameters[k].info.unit == "N" ? 0.02 : 1e-2);
    Parameters up = p, down = p;
    up[k] += h, down[k] -= h;
    const auto plus = solve_equilibrium(m, up, e.x, ws, tight),
               minus = solve_equilibrium(m, down, e.x, ws, tight);
    const Vector quotient = (plus.x - minus.x) / (2 * h);
    EXPECT_LE((quotient - s.col(k)).norm(), 2e-4 * std::max(s.col(k).norm(), 1e-12))
        << m.parameters[k].name.text();
  }
}

}  // namespace
}  // namespace genio
