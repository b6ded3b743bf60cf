// Fewer triangles, near to what was there, and as closed.

#include "speaker/decimation/decimate.hpp"

#include <random>

#include "forward/geometry/surfaces/bone_distance.hpp"
#include "speaker/solid/hausdorff.hpp"
#include "speaker/solid/surface_figures.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/speaker/shapes.hpp"

namespace genio {
namespace {

using test::ball;

/// A jaw of 15 000 triangles, and as coarse as the seed's.
struct Jaw {
  TriangleSurface fine;
  KeptRegion spine;
  DecimatedSurface coarse;
};

const Jaw& jaw() {
  static const Jaw made = [] {
    Jaw j;
    j.spine.balls.push_back({test::jaw_spine, 10e-3});
    j.fine = decimate(test::jaw_like(1.8e-3), {15000, {}, {}, {}}).surface;
    j.coarse = decimate(j.fine, {1450, {}, j.spine, {}});
    return j;
  }();
  return made;
}

TEST(Decimation, AJawOf15000TrianglesKeepsItsShapeIn1450) {
  const Jaw& j = jaw();
  ASSERT_EQ(j.fine.triangles.size(), 15000u);
  const SurfaceFigures f = surface_figures(j.coarse.surface), g = surface_figures(j.fine);
  EXPECT_EQ(f.triangles, 1450);
  EXPECT_TRUE(j.coarse.reached);
  EXPECT_TRUE(f.closed);
  EXPECT_TRUE(f.manifold);
  EXPECT_EQ(f.euler, g.euler);
  EXPECT_LE(j.coarse.hausdorff, 0.5e-3);
  EXPECT_LE(j.coarse.hausdorff_kept, 0.15e-3);
  EXPECT_NEAR(f.volume, g.volume, 0.02 * g.volume);
  RecordProperty("hausdorff_um", int(1e6 * j.coarse.hausdorff));
  RecordProperty("hausdorff_kept_um", int(1e6 * j.coarse.hausdorff_kept));
}

TEST(Decimation, TheDistanceTellsOfPlacesBetweenVertices) {
  // No place of either surface, taken by chance, is farther off than what was measured.
  const Jaw& j = jaw();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  double farthest = 0;
  for (const auto& [from, to] :
       {std::pair{&j.fine, &j.coarse.surface}, {&j.coarse.surface, &j.fine}}) {
    const SurfaceDistance distance(*to);
    for (int k = 0; k < 20000; ++k) {
      const auto& t = from->triangles[size_t(part(random) * double(from->triangles.size()))];
      double u = part(random), v = part(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 &a = from->vertices[size_t(t[0])], &b = from->vertices[size_t(t[1])],
                 &c = from->vertices[size_t(t[2])];
      farthest = std::max(farthest, std::abs(distance(a + u * (b - a) + v * (c - a))));
    }
  }
  EXPECT_LE(farthest, j.coarse.hausdorff + 2e-6);
  EXPECT_GT(farthest, 0.5 * j.coarse.hausdorff);
}

TEST(Decimation, BoundsHoldAndComeBeforeTheNumber) {
  const TriangleSurface fine = jaw().fine;
  const DecimatedSurface some = decimate(fine, {200, 0.2e-3, jaw().spine, 0.05e-3});
  EXPECT_TRUE(some.within_bounds);
  EXPECT_FALSE(some.reached);
  EXPECT_LE(some.hausdorff, 0.2e-3);
  EXPECT_LE(some.hausdorff_kept, 0.05e-3);
  EXPECT_GT(some.surface.triangles.size(), 200u);
  EXPECT_LT(some.surface.triangles.size(), 6000u);
  EXPECT_TRUE(surface_figures(some.surface).closed && surface_figures(some.surface).manifold);
}

TEST(Decimation, NormalsStayOutwardsButForSlivers) {
  const TriangleSurface coarse = decimate(ball(10e-3, 1.5e-3), {200, {}, {}, {}}).surface;
  for (const auto& t : coarse.triangles) {
    const Vec3 &a = coarse.vertices[size_t(t[0])], &b = coarse.vertices[size_t(t[1])],
               &c = coarse.vertices[size_t(t[2])];
    const Vec3 n = (b - a).cross(c - a);
    if (n.norm() > 1e-8) {
      EXPECT_GT(n.dot(a + b + c), 0);
    }
  }
}

TEST(Decimation, EndsWithATetrahedronAndKeepsHandlesAndRims) {
  const TriangleSurface few = decimate(ball(10e-3, 2e-3), {4, {}, {}, {}}).surface;
  EXPECT_TRUE(surface_figures(few).manifold && surface_figures(few).closed);
  EXPECT_EQ(surface_figures(few).euler, 2);
  EXPECT_GE(few.triangles.size(), 4u);
  const auto ring = test::body({-0.04, -0.04, -0.02}, {0.04, 0.04, 0.02}, 3e-3, [](const Vec3& p) {
    return std::hypot(std::hypot(p[0], p[1]) - 0.02, p[2]) - 0.008;
  });
  const SurfaceFigures f = surface_figures(decimate(ring, {60, {}, {}, {}}).surface);
  EXPECT_TRUE(f.closed && f.manifold);
  EXPECT_EQ(f.euler, 0);
  // A square plate of 30 x 30 cells becomes a few triangles with the same rim.
  TriangleSurface plate;
  for (int i = 0; i <= 30; ++i)
    for (int k = 0; k <= 30; ++k) plate.vertices.emplace_back(1e-3 * i, 1e-3 * k, 0);
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 30; ++k) {
      const int a = 31 * i + k;
      plate.triangles.push_back({a, a + 31, a + 1});
      plate.triangles.push_back({a + 1, a + 31, a + 32});
    }
  const DecimatedSurface flat = decimate(plate, {20, {}, {}, {}});
  EXPECT_LE(flat.surface.triangles.size(), 20u);
  EXPECT_LT(flat.hausdorff, 1e-6);
  EXPECT_EQ(surface_figures(flat.surface).euler, 1);
}

TEST(Decimation, LeavesEdgesOfThreeTrianglesAlone) {
  TriangleSurface surface = ball(10e-3, 2e-3);
  const auto& t = surface.triangles[10];
  surface.vertices.emplace_back(0, 0, 0.03);
  surface.triangles.push_back({t[0], t[1], int(surface.vertices.size()) - 1});
  const DecimatedSurface coarse = decimate(surface, {100, {}, {}, {}});
  EXPECT_FALSE(surface_figures(coarse.surface).manifold);  // still there
  EXPECT_LE(coarse.surface.triangles.size(), 110u);
}

/// Force of the contact's springs on a grid of places that dips into the jaw from inside
/// [relative].
Vec3 spring_force(const TriangleSurface& surface) {
  const BoneDistance distance(surface);
  Vec3 sum = Vec3::Zero();
  constexpr double tongue = 14e-3, spacing = 0.25e-3;  // a round tongue tip behind the chin [m]
  const Vec3 centre(18.5e-3, 0, 0);
  for (double a = -1.2; a < 1.2; a += spacing / tongue)
    for (double b = -1; b < 1; b += spacing / tongue) {
      const Vec3 out(-std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
      const Vec3 at = centre + tongue * out;
      const double depth = -distance(at);
      if (depth > 0)
        sum += std::cos(b) * depth * (distance.face().foot(at).place - at).normalized();
    }
  return sum;
}

TEST(Decimation, AFixedPoseTouchesWithTheSameForce) {
  const Vec3 fine = spring_force(jaw().fine), coarse = spring_force(jaw().coarse.surface);
  ASSERT_GT(fine.norm(), 0);
  EXPECT_LT((fine - coarse).norm(), 0.03 * fine.norm());
}

TEST(Decimation, OfTheGrenobleBonesKeepsToTheBounds) {
  const std::string folder = test::reference_folder();
  if (folder.empty()) GTEST_SKIP() << "the reference data are not here";
  for (const char* name : {"ICPHyoid3", "ICPJaw3", "ICPPalate3", "palate8low2"}) {
    const TriangleSurface fine = read_surface(folder + "/grenoble/surfaces_icp_m/" + name + ".obj");
    const DecimatedSurface coarse = decimate(fine, {600, 0.5e-3, {}, {}});
    const SurfaceFigures f = surface_figures(fine), g = surface_figures(coarse.surface);
    EXPECT_TRUE(coarse.within_bounds) << name;
    EXPECT_LE(coarse.hausdorff, 0.5e-3) << name;
    EXPECT_EQ(f.closed, g.closed) << name;
    EXPECT_EQ(f.euler, g.euler) << name;
    RecordProperty(std::string(name) + "_triangles", g.triangles);
  }
}

}  // namespace
}  // namespace genio
