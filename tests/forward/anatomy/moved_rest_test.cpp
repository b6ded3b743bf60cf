// Modes of anatomy go with a tongue: through files, to its half and to the refined one.

#include "forward/effects/modes/moved_rest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "forward/anatomy/refined_model.hpp"
#include "forward/effects/modes/anatomy_modes.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/model/half_model.hpp"
#include "forward/model/mirror.hpp"
#include "forward/statics/equilibrium.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

ModelDescription moded_tongue() {
  ModelDescription d = read_description(test::generic_model());
  const auto plain = plain_modes(d);
  return with_modes(std::move(d), plain);
}

void expect_same_points(const ModelDescription& a, const ModelDescription& b, double tolerance) {
  ASSERT_EQ(a.mesh.nodes.size(), b.mesh.nodes.size());
  for (size_t n = 0; n < a.mesh.nodes.size(); ++n)
    EXPECT_LT((a.mesh.nodes[n] - b.mesh.nodes[n]).norm(), tolerance);
  const auto p = fixed_points(a.muscles), q = fixed_points(b.muscles);
  ASSERT_EQ(p.size(), q.size());
  EXPECT_FALSE(p.empty());
  for (size_t i = 0; i < p.size(); ++i) EXPECT_LT((p[i] - q[i]).norm(), tolerance);
  ASSERT_EQ(a.palate->vertices.size(), b.palate->vertices.size());
  for (size_t i = 0; i < a.palate->vertices.size(); ++i)
    EXPECT_LT((a.palate->vertices[i] - b.palate->vertices[i]).norm(), tolerance);
}

const std::vector<double> somewhere = {0.7, -1.2};

TEST(MovedRest, RefiningAndMovingMayChangePlaces) {
  const ModelDescription d = moded_tongue();
  expect_same_points(moved(refined(d), somewhere), refined(moved(d, somewhere)), 1e-12);
}

TEST(MovedRest, HalvingAndMovingMayChangePlaces) {
  const ModelDescription d = moded_tongue();
  expect_same_points(moved(half_of(d, "tongue"), somewhere), half_of(moved(d, somewhere), "tongue"),
                     1e-12);
}

TEST(MovedRest, SymmetricModesLeaveTheTongueSymmetric) {
  ModelDescription d = moded_tongue();
  d.effects["anatomy"] = {{"size", 0.7}, {"pharynx", -1.2}};
  const Model m = build_model(d, "tongue");
  const auto mirror = mirror_of(m, {"anatomy.size", "anatomy.pharynx"});
  ASSERT_TRUE(mirror);
  Parameters p = default_parameters(m), q = default_parameters(mirror->half);
  set_command(m, "GGP", 3, p), set_command(mirror->half, "GGP", 1.5, q);
  Workspace ws(m), half_ws(mirror->half);
  const auto whole = solve_equilibrium(m, p, m.rest, ws),
             half = solve_equilibrium(mirror->half, q, mirror->half.rest, half_ws);
  ASSERT_TRUE(whole) << whole.message;
  ASSERT_TRUE(half) << half.message;
  EXPECT_GT((whole.x - at_anatomy(m, p)->rest).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((whole.x - Positions(mirror->whole(half.x))).cwiseAbs().maxCoeff(), 2e-5);
}

TEST(MovedRest, AModeOfOneSideHasNoMirror) {
  ModelDescription d = read_description(test::generic_model());
  d = with_modes(std::move(d), {{"left", [](const Vec3& x) -> Vec3 {
                                   return {0, 0, -0.05 * x[1]};
                                 }}});
  const Model m = build_model(d, "tongue");
  EXPECT_TRUE(mirror_of(m));
  EXPECT_FALSE(mirror_of(m, {"anatomy.left"}));
  d.effects["anatomy"]["left"] = 1;
  EXPECT_FALSE(mirror_of(build_model(d, "tongue")));
}

TEST(MovedRest, NamesAndNumbersOfModesAreLookedAt) {
  const auto still = [](const Vec3&) -> Vec3 { return Vec3::Zero(); };
  const ModelDescription d = test::small_block();
  EXPECT_THROW(with_modes(d, {{"", still}}), InputError);
  EXPECT_THROW(with_modes(d, {{"a b", still}}), InputError);
  EXPECT_THROW(with_modes(d, {{"a", still}, {"a", still}}), InputError);
  EXPECT_THROW(with_modes(d, {{"a", [](const Vec3&) -> Vec3 { return Vec3::Constant(NAN); }}}),
               InputError);
  ModelDescription short_of_one = with_modes(d, {{"a", still}});
  short_of_one.modes[0].palate.pop_back();
  EXPECT_THROW(build_model(short_of_one, "block"), InputError);
}

/// The small block with modes on disk, whose files a test may spoil.
class ModesOnDisk : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("genio_modes_" + std::to_string(::getpid()));
    ModelDescription d = with_modes(test::small_block(), test::test_modes());
    d.effects["anatomy"]["size"] = -0.25;
    write_description(d, folder.string());
  }
  void TearDown() override { fs::remove_all(folder); }
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::ifstream in(folder / file);
    std::stringstream text;
    text << in.rdbuf();
    std::string s = text.str();
    size_t at = s.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    s.replace(at, from.size(), to);
    std::ofstream(folder / file) << s;
  }
  std::string error() const {
    try {
      read_model(folder.string());
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  fs::path folder;
};

TEST_F(ModesOnDisk, AreReadAsTheyWereWritten) {
  const ModelDescription d = read_description(folder.string());
  const ModelDescription as_was = with_modes(test::small_block(), test::test_modes());
  ASSERT_EQ(d.modes.size(), 2u);
  EXPECT_EQ(d.modes[0].name, "depth");  // by name
  EXPECT_EQ(d.modes[1].name, "size");
  EXPECT_EQ(d.effects.at("anatomy").at("size"), -0.25);
  for (size_t a = 0; a < d.mesh.nodes.size(); ++a)
    EXPECT_LT((d.modes[1].nodes[a] - as_was.modes[0].nodes[a]).norm(), 1e-11);
  ASSERT_EQ(d.modes[1].fixed_points.size(), 1u);
  EXPECT_LT((d.modes[1].fixed_points[0] - as_was.modes[0].fixed_points[0]).norm(), 1e-11);
  ASSERT_EQ(d.modes[1].palate.size(), 4u);
  EXPECT_LT((d.modes[1].palate[2] - as_was.modes[0].palate[2]).norm(), 1e-11);
  EXPECT_TRUE(d.modes[1].jaw.empty());
}

TEST_F(ModesOnDisk, WhatIsWrongIsNamedWithItsFile) {
  replace("model.toml", "size = -0.25", "sise = -0.25");
  EXPECT_NE(error().find("sise"), std::string::npos) << error();
  replace("model.toml", "sise = -0.25", "size = -3.25");
  EXPECT_NE(error().find("-3 to 3 sd"), std::string::npos) << error();
  replace("model.toml", "size = -3.25", "size = -0.25");
  EXPECT_EQ(error(), "");
  replace("fibres.vtp", "anatomy_size", "anatomy_sighs");
  EXPECT_NE(error().find("fibres.vtp: array 'anatomy_size' is missing"), std::string::npos)
      << error();
  replace("fibres.vtp", "anatomy_sighs", "anatomy_size");
  fs::remove(folder / "anatomy.vtp");
  EXPECT_NE(error().find("anatomy.vtp"), std::string::npos) << error();
}

}  // namespace
}  // namespace genio
