// The real Grenoble tongue, read in place; skipped where it is absent.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "forward/anatomy/import_grenoble.hpp"
#include "forward/model/build_model.hpp"
#include "forward/statics/equilibrium.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

class Grenoble : public testing::Test {
 protected:
  void SetUp() override {
    if (test::reference_folder().empty()) GTEST_SKIP() << "the reference data are not here";
    d = import_grenoble(test::reference_folder() + "/grenoble");
  }
  ModelDescription d;
};

TEST_F(Grenoble, HasItsPublishedMesh) {
  EXPECT_EQ(d.mesh.nodes.size(), 946u);
  EXPECT_EQ(d.mesh.elements.size(), 740u);
  EXPECT_NEAR(1e6 * mesh_volume(d.mesh, rest_positions(d.mesh)), 102.3, 0.1);
  double worst = 1;
  for (int e = 0; e < 740; ++e) worst = std::min(worst, corner_jacobian_ratio(d.mesh, e));
  EXPECT_NEAR(worst, 0.0054, 1e-4);
  EXPECT_EQ(d.muscles.size(), 21u);
}

TEST_F(Grenoble, SurvivesBeingWrittenAndRead) {
  const auto folder = std::filesystem::temp_directory_path() / "genio_grenoble_test";
  write_description(d, folder.string());
  const auto again = read_description(folder.string());
  std::filesystem::remove_all(folder);
  EXPECT_EQ(again.mesh.elements, d.mesh.elements);
  EXPECT_EQ(again.midsagittal, d.midsagittal);
  for (size_t m = 0; m < d.muscles.size(); ++m) {
    EXPECT_EQ(again.muscles[m].elements, d.muscles[m].elements);
    EXPECT_EQ(again.muscles[m].fibres.size(), d.muscles[m].fibres.size());
  }
}

/// The independent static solution of the same problem: cadaver law, no contact, no gravity;
/// 3 % of the largest displacement.
TEST_F(Grenoble, MeetsTheIndependentSolution) {
  d.effects.erase("palate_contact");
  d.effects.erase("jaw_contact");
  const Model m = build_model(d, "grenoble");
  Workspace ws(m);
  struct Row {
    const char* muscle;
    double newtons, a10, a20, tip_x, tip_z, dorsum_x, dorsum_z, base_x, base_z, largest;
  };
  for (const Row& r : {Row{"GGP", 4, 192, 90, -10.10, -18.62, -20.24, -1.43, -17.25, 1.73, 21.47},
                       Row{"HG", 2, 192, 90, 18.36, 14.15, 19.15, -6.12, 10.20, -11.67, 23.2},
                       Row{"GGP", 4, 1037, 486, -4.22, -5.45, -6.51, 0.80, -6.87, 0.08, 7.65},
                       Row{"HG", 2, 1037, 486, 6.42, 6.86, 8.17, -1.33, 4.21, -4.20, 9.4}}) {
    Parameters p = default_parameters(m);
    set_parameter(m, "elasticity.a10", r.a10, p);
    set_parameter(m, "elasticity.a20", r.a20, p);
    set_parameter(m, "elasticity.kappa", 1000 * r.a10, p);
    set_command(m, r.muscle, r.newtons, p);
    const auto e = solve_equilibrium(m, p, m.rest, ws);
    ASSERT_TRUE(e) << e.message;
    const Vector u = 1e3 * (e.x - m.rest);
    const double tolerance = 0.03 * r.largest;
    EXPECT_NEAR(u[3 * 919], r.tip_x, tolerance);
    EXPECT_NEAR(u[3 * 919 + 2], r.tip_z, tolerance);
    EXPECT_NEAR(u[3 * 869], r.dorsum_x, tolerance);
    EXPECT_NEAR(u[3 * 869 + 2], r.dorsum_z, tolerance);
    EXPECT_NEAR(u[3 * 927], r.base_x, tolerance);
    EXPECT_NEAR(u[3 * 927 + 2], r.base_z, tolerance);
  }
}

/// The tip folds up against the palate and the tangent turns indefinite many times on the way.
TEST_F(Grenoble, CadaverHyoglossusInContactIsFound) {
  const Model m = build_model(d, "grenoble");
  Workspace ws(m);
  Parameters p = default_parameters(m);
  set_parameter(m, "elasticity.a10", 192, p);
  set_parameter(m, "elasticity.a20", 90, p);
  set_parameter(m, "elasticity.kappa", 192e3, p);
  set_command(m, "HG", 2, p);
  const auto e = solve_equilibrium(m, p, m.rest, ws);
  ASSERT_TRUE(e) << e.message;
  EXPECT_LT(e.factorizations, 1000);
  EXPECT_LT(max_penetration(m, e.x, e.parameters), 1e-4);
}

TEST_F(Grenoble, EveryMuscleAloneAndAllTogetherHaveAnEquilibrium) {
  const Model m = build_model(d, "grenoble");
  Workspace ws(m);
  for (const std::string& name : test::muscle_names) {
    Parameters p = default_parameters(m);
    set_command(m, name, 2, p);
    const auto e = solve_equilibrium(m, p, m.rest, ws);
    EXPECT_TRUE(e) << name << ": " << e.message;
    EXPECT_LT(max_penetration(m, e.x, e.parameters), 1e-4) << name;
  }
  Parameters p = default_parameters(m);
  for (const auto& muscle : m.muscles) set_command(m, muscle.name, 0.05 * muscle.max_force, p);
  const auto e = solve_equilibrium(m, p, m.rest, ws);
  EXPECT_TRUE(e) << e.message;
}

}  // namespace
}  // namespace genio
