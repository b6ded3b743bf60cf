#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/figures/forward/deformation_table.hpp"
#include "tests/forward/small_model.hpp"

namespace genio::bench {
namespace {

TEST(Deformation, LevelsEndAtTheMaximum) {
  EXPECT_EQ(deformation_levels(0.05), (std::vector<double>{0.05}));
  EXPECT_EQ(deformation_levels(0.3), (std::vector<double>{0.1, 0.25, 0.3}));
  EXPECT_EQ(deformation_levels(2), (std::vector<double>{0.1, 0.25, 0.5, 1, 2}));
  EXPECT_EQ(deformation_levels(18.5), (std::vector<double>{0.1, 0.25, 0.5, 1, 2, 18.5}));
}

TEST(Deformation, MusclesOfBothSidesAreOneAndAnUnpairedOneIsHalved) {
  const Model m = read_model(test::generic_model());
  const std::vector<std::string> names = both_sided_muscles(m);
  EXPECT_EQ(names.size(), test::muscle_names.size());
  EXPECT_DOUBLE_EQ(maximum_a_side(m, "GGP"), 18.5);
  EXPECT_DOUBLE_EQ(maximum_a_side(m, "SL"), 9.5);
  EXPECT_THROW(maximum_a_side(m, "GGX"), InputError);
}

TEST(Deformation, BoundOfAPowerLawIsReachedExactlyBetweenLevels) {
  std::vector<double> forces = {0.1, 0.25, 0.5, 1, 2}, values;
  for (const double f : forces) values.push_back(3 * f * f);
  EXPECT_NEAR(first_reached(forces, values, 1), std::sqrt(1.0 / 3), 1e-12);
  EXPECT_EQ(first_reached(forces, values, 0.01), 0);
  EXPECT_TRUE(std::isinf(first_reached(forces, values, 13)));
}

TEST(Deformation, AShiftOfTheSurfaceIsItsOwnDifference) {
  const Model m = read_model(test::generic_model());
  const auto shifted = [&](const Vec3& by) -> Positions {
    return m.rest + by.replicate(m.rest.size() / 3, 1);
  };
  const ShapeDifference d = difference(m, shifted({0, 0, 2e-3}), shifted({1e-3, 0, 2e-3}));
  EXPECT_NEAR(d.rms, 1e-3, 1e-12);
  EXPECT_NEAR(d.largest, 1e-3, 1e-12);
  EXPECT_NEAR(d.relative, 0.5, 1e-9);
}

TEST(Deformation, QualityTellsVolumeAndWhatFolds) {
  const Model m = test::small_model();
  const ElementQuality grown = element_quality(m, 1.1 * m.rest);
  EXPECT_NEAR(grown.volume, std::pow(1.1, 3) - 1, 1e-12);
  EXPECT_NEAR(grown.least_ratio, element_quality(m, m.rest).least_ratio, 1e-12);
  EXPECT_EQ(grown.folded, 0);
  Positions mirrored = m.rest;
  for (Eigen::Index a = 0; a < mirrored.size(); a += 3) mirrored[a] *= -1;
  EXPECT_EQ(element_quality(m, mirrored).folded, int(m.mesh.elements.size()));
}

TEST(Deformation, TableSaysWhatFailedAndWhereBoundsAreReached) {
  DeformationPair pair(test::small_block(), "block");
  std::vector<DeformationRow> rows = pair.rows("GGP");
  ASSERT_EQ(rows.size(), deformation_levels(2).size());
  for (DeformationRow& row : rows)
    if (row.force > 0.25) row.large.status = SolveStatus::failed, row.large.message = "no luck";
  std::vector<Json> all;
  for (const DeformationRow& row : rows) all.push_back(deformation_json(pair.model(), row));
  EXPECT_TRUE(all.back()["difference"].is_null());
  EXPECT_EQ(all.back()["status"], "failed");
  const Json result = {{"model", "block"}, {"rows", all}, {"limits", {deformation_limits(all)}}};
  const std::string text = deformation_text(result);
  EXPECT_NE(text.find("no luck"), std::string::npos);
  EXPECT_NE(text.find("touches from"), std::string::npos);
}

}  // namespace
}  // namespace genio::bench
