// A model becomes another speaker's: close to the outline, whole, and its own mirror image.

#include "speaker/adaptation/adapt.hpp"

#include "forward/anatomy/import_grenoble.hpp"
#include "speaker/adaptation/outline_of_model.hpp"
#include "speaker/adaptation/surface_registration.hpp"
#include "speaker/outline/rigid_frame.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/speaker/shapes.hpp"

namespace genio {
namespace {

ModelDescription generic_tongue() { return read_description(test::generic_model()); }

/// A smooth map that makes a longer, flatter tongue with a raised blade.
Vec2 other_speaker(const Vec2& p) {
  const double bump = std::exp(-std::pow((p[0] - 0.085) / 0.03, 2));
  return {1.06 * p[0] + 0.02 * (p[1] - 0.08), 0.95 * p[1] + 0.002 * bump};
}

double rms_between(const HexMesh& a, const HexMesh& b) {
  double squares = 0;
  for (size_t k = 0; k < a.nodes.size(); ++k) squares += (a.nodes[k] - b.nodes[k]).squaredNorm();
  return std::sqrt(squares / double(a.nodes.size()));
}

bool is_its_mirror_image(const HexMesh& base, const HexMesh& mesh) {
  for (size_t a = 0; a < base.nodes.size(); ++a)
    for (size_t b = 0; b < base.nodes.size(); ++b) {
      const Vec3 image(base.nodes[b][0], -base.nodes[b][1], base.nodes[b][2]);
      if ((base.nodes[a] - image).norm() > 1e-6) continue;
      if (mesh.nodes[a][0] != mesh.nodes[b][0] || mesh.nodes[a][1] != -mesh.nodes[b][1] ||
          mesh.nodes[a][2] != mesh.nodes[b][2])
        return false;
    }
  return true;
}

TEST(Adaptation, ToItsOwnOutlineLeavesAModelAsItIs) {
  const ModelDescription base = generic_tongue();
  const Adaptation a = adapt_model(base, "generic",
                                   outline_of_model(
                                       base, [](const Vec2& p) { return p; }, 1e-3));
  ASSERT_TRUE(a) << a.message;
  EXPECT_LT(1e3 * a.distances.rms, 0.1);
  EXPECT_LT(1e3 * rms_between(a.model.mesh, base.mesh), 0.2);
  EXPECT_NEAR(a.max_force_scale, 1, 0.02);
}

TEST(Adaptation, UndoesAKnownSmoothMap) {
  const ModelDescription base = generic_tongue();
  const Adaptation there =
      adapt_model(base, "generic", outline_of_model(base, other_speaker, 1e-3));
  ASSERT_TRUE(there) << there.message;
  EXPECT_LT(1e3 * there.distances.rms, 0.5);
  const Adaptation back = adapt_model(there.model, "other",
                                      outline_of_model(
                                          base, [](const Vec2& p) { return p; }, 1e-3));
  ASSERT_TRUE(back) << back.message;
  EXPECT_LT(1e3 * back.distances.rms, 0.3);
  EXPECT_LT(1e3 * rms_between(back.model.mesh, base.mesh), 0.2);
}

TEST(Adaptation, FindsAKnownSmoothMapByTheOutlineAlone) {
  const ModelDescription base = generic_tongue();
  const Adaptation a = adapt_model(base, "generic", outline_of_model(base, other_speaker, 1e-3));
  ASSERT_TRUE(a) << a.message;
  HexMesh truth = base.mesh;
  for (Vec3& x : truth.nodes) {
    const Vec2 q = other_speaker({x[0], x[2]});
    x = Vec3(q[0], x[1], q[1]);
  }
  // The outline was laid by its palate, so the head may be elsewhere.
  std::vector<Vec2> found, there;
  for (size_t k = 0; k < truth.nodes.size(); ++k) {
    found.emplace_back(a.model.mesh.nodes[k][0], a.model.mesh.nodes[k][2]);
    there.emplace_back(truth.nodes[k][0], truth.nodes[k][2]);
  }
  const Similarity back = rigid_motion(found, there);
  HexMesh laid = a.model.mesh;
  for (Vec3& x : laid.nodes) {
    const Vec2 q = back({x[0], x[2]});
    x = Vec3(q[0], x[1], q[1]);
  }
  EXPECT_LT(1e3 * rms_between(laid, truth), 0.2);
}

TEST(Adaptation, KeepsASymmetricTongueSymmetric) {
  const ModelDescription base = generic_tongue();
  const Adaptation a = adapt_model(base, "generic", outline_of_model(base, other_speaker, 1e-3));
  EXPECT_TRUE(is_its_mirror_image(base.mesh, a.model.mesh));
}

TEST(Adaptation, CarriesEffectsAndScalesForcesWithCrossSections) {
  ModelDescription base = generic_tongue();
  base.effects["gravity"] = {{"z", -9.81}};
  const auto larger = [](const Vec2& p) { return Vec2(1.1 * p); };
  const Adaptation a = adapt_model(base, "generic", outline_of_model(base, larger, 1e-3));
  ASSERT_TRUE(a) << a.message;
  EXPECT_EQ(a.model.effects, base.effects);
  EXPECT_NEAR(a.scale, 1.1, 0.01);
  EXPECT_NEAR(a.max_force_scale, 1.21, 0.03);
  EXPECT_NEAR(1e6 * a.volume, 1.331e6 * mesh_volume(base.mesh, rest_positions(base.mesh)), 3);
}

TEST(Adaptation, OfTheGrenobleTongueToAnotherSpeakerBySurfaceAlone) {
  const std::string data = test::reference_folder();
  if (data.empty()) GTEST_SKIP() << "the reference data are not here";
  const ModelDescription third = import_grenoble(data + "/grenoble");
  HexMesh first = third.mesh;
  std::ifstream nodes(data + "/grenoble/icp_full_model/tongueIcp.1.node");
  ASSERT_TRUE(nodes);
  for (Vec3& x : first.nodes) {
    int number;
    nodes >> number >> x[0] >> x[1] >> x[2];
  }
  const TriangleSurface target = outer_surface(third.mesh);
  const SurfaceRegistration r = register_surface(affinely_laid(first, target), target);
  EXPECT_LT(1e3 * rms_between(r.mesh, third.mesh), 2);
  EXPECT_LT(1e3 * r.rms, 0.5);
  EXPECT_GT(r.min_jacobian, 0);
}

TEST(Adaptation, MeetsMeasuredSpeakers) {
  const std::string data = test::reference_folder();
  if (data.empty()) GTEST_SKIP() << "the reference data are not here";
  const std::string path = data + "/mri_41_speakers/contours_cm.csv";
  const ModelDescription base = generic_tongue();
  for (const char* speaker : {"1", "11", "41"}) {
    const Adaptation a = adapt_model(base, "generic", read_outline(path, speaker));
    EXPECT_TRUE(a) << speaker << ": " << a.message;
    EXPECT_LT(1e3 * a.distances.free_rms, 0.5) << speaker;
    EXPECT_LT(1e3 * a.distances.floor_rms, 0.5) << speaker;
  }
}

}  // namespace
}  // namespace genio
