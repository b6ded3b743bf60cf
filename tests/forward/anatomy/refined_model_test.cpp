#include "forward/anatomy/refined_model.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

// Once the middles of warped faces were missed, and the fine tongue's surface had dimples of a
// millimetre where a fibre was not.
TEST(RefinedModel, HasAFibreAtEveryNewNodeAmongThoseOfAMuscle) {
  const ModelDescription d = read_description(test::generic_model());
  const ModelDescription fine = refined(d);
  for (size_t m = 0; m < d.muscles.size(); ++m) {
    if (bilateral_name(d.muscles[m].name) != "VERT") continue;
    // Ends of the fibres make a grid; so must those of the finer muscle.
    std::set<int> ends, fine_ends;
    for (const Fibre& f : d.muscles[m].fibres) ends.insert(f.front().node);
    for (const Fibre& f : fine.muscles[m].fibres) fine_ends.insert(f.front().node);
    EXPECT_EQ(fine.muscles[m].fibres.size(), fine_ends.size());
    const HexMesh& mesh = d.mesh;
    std::set<int> expected = ends;
    for (const Quad& q : boundary_quads(mesh)) {
      bool all = true;
      Vec3 middle = Vec3::Zero();
      for (int a : q) all &= ends.contains(a), middle += mesh.nodes[size_t(a)] / 4;
      for (size_t i = 0; i < 4; ++i) {
        const int a = q[i], b = q[(i + 1) % 4];
        if (!ends.contains(a) || !ends.contains(b)) continue;
        const Vec3 half = 0.5 * (mesh.nodes[size_t(a)] + mesh.nodes[size_t(b)]);
        for (size_t n = 0; n < fine.mesh.nodes.size(); ++n)
          if ((fine.mesh.nodes[n] - half).norm() < 1e-9) expected.insert(int(n));
      }
      for (size_t n = 0; n < fine.mesh.nodes.size() && all; ++n)
        if ((fine.mesh.nodes[n] - middle).norm() < 1e-9) expected.insert(int(n));
    }
    EXPECT_GT(expected.size(), 2 * ends.size());
    EXPECT_EQ(fine_ends, expected);
  }
}

}  // namespace
}  // namespace genio
