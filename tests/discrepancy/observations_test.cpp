// What an observations file says is read, and what is wrong with it is said where it stands.

#include "discrepancy/conditions/observations.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "forward/model/build_model.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

class ObservationsFile : public testing::Test {
 protected:
  std::string error(const std::string& text) {
    const std::string path = testing::TempDir() + "observations.toml";
    std::ofstream(path) << text;
    try {
      read_observations(path, m);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  const Model m = read_model(test::generic_model());
  const std::string shape =
      std::string("\"") + GENIO_SOURCE_DIR + "/data/examples/example_shape.csv\"";
};

TEST_F(ObservationsFile, ErrorsNameFileLineAndField) {
  const auto expect_says = [&](const std::string& text, const std::vector<std::string>& parts) {
    const std::string e = error(text);
    for (const auto& part : parts) EXPECT_NE(e.find(part), std::string::npos) << e;
  };
  expect_says("noise_mm = 0.4\n", {"observations.toml", "no [[condition]]"});
  expect_says("[[condition]]\nname = \"a\"\n", {"'noise_mm' is missing"});
  expect_says("noise_mm = 0.4\n[[condition]]\nname = \"a\"\ntarget = " + shape +
                  "\nforces_N = { GPP = 1 }\n",
              {":5:", "GPP", "did you mean GGP"});
  expect_says("noise_mm = 0.4\n[[condition]]\nname = \"a\"\ntarget = " + shape +
                  "\neffects = { jaw = 1 }\n",
              {":5", "jaw", "did you mean"});
  expect_says(
      "noise_mm = 0.4\n[[condition]]\nname = \"a\"\ntarget = " + shape + "\nheldout = true\n",
      {"every condition is held out"});
  expect_says("noise_mm = -1\n", {":1:", "noise_mm"});
}

TEST_F(ObservationsFile, KnownForcesAndEffectsAreRead) {
  const std::string path = testing::TempDir() + "good.toml";
  std::ofstream(path) << "noise_mm = 0.4\nforce_sd_percent = 10\n[[condition]]\nname = \"a\"\n"
                         "target = " +
                             shape +
                             "\nforces_N = { GGP = 2.0 }\n"
                             "effects = { jaw_opening = 4.0 }\n";
  const Observations o = read_observations(path, m);
  ASSERT_EQ(o.conditions.size(), 1u);
  const auto& forces = *o.conditions[0].forces;
  EXPECT_NEAR(forces.at("GGP_L").mean, 1, 1e-12);
  EXPECT_NEAR(forces.at("GGP_L").sd, 0.1, 1e-12);
  EXPECT_EQ(o.conditions[0].effects.at({"jaw_opening", "angle"}), 4);
}

}  // namespace
}  // namespace genio
