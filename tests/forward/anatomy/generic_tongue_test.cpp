// The generic tongue against the published figures of the reference tongue, 15 % each.

#include "data/generator/generic_tongue.hpp"

#include <gtest/gtest.h>

#include <map>

#include "forward/geometry/surfaces/closest_point.hpp"
#include "forward/model/build_model.hpp"
#include "forward/statics/equilibrium.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

class GenericTongue : public testing::Test {
 protected:
  const ModelDescription d = read_description(test::generic_model());
  const Positions rest = rest_positions(d.mesh);
};

void expect_within(double value, double reference, const std::string& what) {
  EXPECT_NEAR(value, reference, 0.15 * reference) << what;
}

TEST_F(GenericTongue, MeshIsFineAndWellShaped) {
  EXPECT_GE(d.mesh.elements.size(), 600u);
  EXPECT_LE(d.mesh.elements.size(), 1500u);
  for (size_t e = 0; e < d.mesh.elements.size(); ++e) {
    for (double j : corner_jacobians(d.mesh, int(e))) EXPECT_GT(j, 0) << e;
    EXPECT_GE(corner_jacobian_ratio(d.mesh, int(e)), 0.2) << e;
  }
}

TEST_F(GenericTongue, IsSymmetricAboutTheMidsagittalPlane) {
  for (const Vec3& x : d.mesh.nodes) {
    double nearest = 1;
    for (const Vec3& y : d.mesh.nodes)
      nearest = std::min(nearest, (Vec3(x[0], -x[1], x[2]) - y).norm());
    EXPECT_LT(nearest, 1e-8);
  }
}

TEST_F(GenericTongue, HasThePublishedSize) {
  expect_within(1e6 * mesh_volume(d.mesh, rest), 102.3, "volume");
  Vec3 low = d.mesh.nodes[0], high = low;
  for (const Vec3& x : d.mesh.nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
  expect_within(1e3 * (high - low)[0], 74, "length");
  expect_within(1e3 * (high - low)[1], 65, "width");
  expect_within(1e3 * (high - low)[2], 59, "height");
  double arc = 0;
  for (size_t i = 0; i + 1 < d.midsagittal.size(); ++i)
    if (d.midsagittal[i] == d.landmarks.tip || arc > 0)
      arc += (d.mesh.nodes[d.midsagittal[i + 1]] - d.mesh.nodes[d.midsagittal[i]]).norm();
  expect_within(1e3 * arc, 113, "arc from tip to hyoid");
  const SurfaceDistance palate(*d.palate);
  double gap = 1;
  for (int a : d.midsagittal)
    if (d.mesh.nodes[a][0] > 0.065 && d.mesh.nodes[a][2] > 0.1)
      gap = std::min(gap, std::abs(palate(d.mesh.nodes[a])));
  expect_within(1e3 * gap, 8, "gap below the palate");
}

TEST_F(GenericTongue, MusclesHaveThePublishedLengthsAndForces) {
  const std::map<std::string, std::pair<double, double>> published = {
      // mm, N
      {"GGP", {48, 37}},  {"GGM", {46, 12}},  {"GGA", {36, 18}}, {"HG", {39, 65}},
      {"STY", {45, 24}},  {"SL", {95, 19}},   {"IL", {86, 9}},   {"TRANS", {14, 50}},
      {"VERT", {16, 20}}, {"GH", {31, 17.5}}, {"MH", {24, 39}}};
  std::map<std::string, double> force;
  for (const auto& m : d.muscles) {
    double length = 0;
    for (Fibre f : m.fibres) {
      if (f.front().node < 0) f.erase(f.begin());  // the part inside the tongue
      length += fibre_length(f, rest) / double(m.fibres.size());
    }
    expect_within(1e3 * length, published.at(bilateral_name(m.name)).first, m.name);
    force[bilateral_name(m.name)] += m.max_force;
  }
  EXPECT_EQ(force.size(), published.size());
  for (const auto& [name, f] : force) EXPECT_NEAR(f, published.at(name).second, 1e-9) << name;
}

TEST_F(GenericTongue, FibresInterweave) {
  std::vector<int> families(d.mesh.elements.size(), 0);
  for (const auto& m : d.muscles)
    for (int e : m.elements) ++families[size_t(e)];
  EXPECT_GT(std::count_if(families.begin(), families.end(), [](int n) { return n >= 2; }), 200);
}

TEST_F(GenericTongue, RestsOutsideTheBones) {
  const Model m = build_model(d, "generic");
  EXPECT_EQ(max_penetration(m, m.rest, default_parameters(m)), 0);
  EXPECT_EQ(force(m, m.rest, default_parameters(m)).norm() < 1e-9, true);
}

/// Geniohyoid and others pull fibre segments together until nothing is left of them.
TEST_F(GenericTongue, EveryMuscleAtItsMaximumHasAnEquilibrium) {
  const Model m = build_model(d, "generic");
  Workspace ws(m);
  for (const std::string& name : test::muscle_names) {
    Parameters p = default_parameters(m);
    double most = 0;
    for (const int k : command_parameters(m, name)) most += m.parameters[size_t(k)].info.upper;
    set_command(m, name, most, p);
    const auto e = solve_equilibrium(m, p, m.rest, ws);
    EXPECT_TRUE(e) << name << ": " << e.message;
    EXPECT_LT(e.factorizations, 400) << name;
    EXPECT_LT(max_penetration(m, e.x, e.parameters), 1e-4) << name;
  }
}

}  // namespace
}  // namespace genio
