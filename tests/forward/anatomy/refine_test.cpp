#include "forward/anatomy/refine.hpp"

#include <gtest/gtest.h>

#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

TEST(Refine, KeepsVolumeSurfaceAndOldNodes) {
  const ModelDescription d = read_description(test::generic_model());
  const RefinedMesh r = refined(d.mesh, d.supports);
  EXPECT_EQ(r.mesh.elements.size(), 8 * d.mesh.elements.size());
  EXPECT_EQ(boundary_quads(r.mesh).size(), 4 * boundary_quads(d.mesh).size());
  for (size_t a = 0; a < d.mesh.nodes.size(); ++a) {
    EXPECT_EQ(r.mesh.nodes[a], d.mesh.nodes[a]);
    EXPECT_EQ(r.supports[a], d.supports[a]);
  }
  check_mesh(r.mesh, "refined");
  const double before = mesh_volume(d.mesh, rest_positions(d.mesh));
  EXPECT_NEAR(mesh_volume(r.mesh, rest_positions(r.mesh)), before, 1e-12 * before);
}

TEST(Refine, HoldsOnlyWhatLiesBetweenHeldNodes) {
  const ModelDescription d = test::small_block();
  const RefinedMesh r = refined(d.mesh, d.supports);
  int fixed = 0, hyoid = 0;
  for (Support s : r.supports) fixed += s == Support::fixed, hyoid += s == Support::horizontal;
  // Bottom: 4 x 3 nodes become 7 x 5; its last row of 3 is the hyoid's. Between the two kinds:
  // hyoid.
  EXPECT_EQ(fixed + hyoid, 35);
  EXPECT_EQ(hyoid, 10);
}

}  // namespace
}  // namespace genio
