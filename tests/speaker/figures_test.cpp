// What is counted and measured of surfaces.

#include "speaker/solid/hausdorff.hpp"
#include "speaker/solid/largest_part.hpp"
#include "speaker/solid/surface_figures.hpp"
#include "tests/speaker/shapes.hpp"

namespace genio {
namespace {

using test::ball;
using test::body;

TEST(SurfaceFigures, OfABallAreThoseOfABall) {
  const SurfaceFigures f = surface_figures(ball(10e-3, 0.5e-3));
  EXPECT_TRUE(f.closed && f.manifold);
  EXPECT_EQ(f.euler, 2);
  EXPECT_EQ(f.parts, 1);
  EXPECT_NEAR(f.volume, 4 * std::numbers::pi / 3 * 1e-6, 0.005 * f.volume);
  EXPECT_NEAR(f.area, 4 * std::numbers::pi * 1e-4, 0.01 * f.area);
}

TEST(SurfaceFigures, ARingHasAHandle) {
  const auto ring = body({-0.04, -0.04, -0.02}, {0.04, 0.04, 0.02}, 1e-3, [](const Vec3& p) {
    return std::hypot(std::hypot(p[0], p[1]) - 0.02, p[2]) - 0.008;
  });
  EXPECT_EQ(surface_figures(ring).euler, 0);
  EXPECT_TRUE(surface_figures(ring).manifold);
}

TEST(SurfaceFigures, TellWhatIsOpenTurnedOrTouchesAtAPoint) {
  TriangleSurface surface = ball(10e-3, 2e-3);
  TriangleSurface open = surface;
  open.triangles.pop_back();
  EXPECT_FALSE(surface_figures(open).closed);
  EXPECT_TRUE(surface_figures(open).manifold);
  TriangleSurface turned = surface;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_FALSE(surface_figures(turned).manifold);
  // A second ball that has one vertex in common with the first.
  TriangleSurface two = surface;
  const int n = int(surface.vertices.size());
  for (const Vec3& v : surface.vertices) two.vertices.push_back(v + Vec3(0.1, 0, 0));
  for (const auto& t : surface.triangles) two.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  EXPECT_TRUE(surface_figures(two).manifold);
  EXPECT_EQ(surface_figures(two).parts, 2);
  EXPECT_EQ(surface_figures(two).euler, 4);
  for (auto& t : two.triangles)
    for (int& v : t)
      if (v == n) v = 0;
  EXPECT_TRUE(surface_figures(two).closed);
  EXPECT_FALSE(surface_figures(two).manifold);
}

TEST(SurfaceFigures, NoiseMakesNoFieldsSurfaceOpenOrBranched) {
  unsigned state = 7;
  const auto noise = [&](const Vec3&) {
    state = state * 1664525u + 1013904223u;
    return double(state >> 8) / double(1 << 24) - 0.5;
  };
  const SurfaceFigures f = surface_figures(body(Vec3::Zero(), Vec3::Constant(0.02), 1e-3, noise));
  EXPECT_GT(f.triangles, 10000);
  EXPECT_TRUE(f.closed);
  EXPECT_TRUE(f.manifold);
}

TEST(LargestPart, LeavesSpecksOut) {
  const auto both = body({-0.02, -0.02, -0.02}, {0.05, 0.02, 0.02}, 1e-3, [](const Vec3& p) {
    return std::min(p.norm() - 0.015, (p - Vec3(0.04, 0, 0)).norm() - 0.004);
  });
  ASSERT_EQ(surface_figures(both).parts, 2);
  const SurfaceFigures f = surface_figures(largest_part(both));
  EXPECT_EQ(f.parts, 1);
  EXPECT_NEAR(f.volume, 4 * std::numbers::pi / 3 * std::pow(0.015, 3), 0.02 * f.volume);
}

TEST(Hausdorff, IsTheDistanceOfShiftedAndGrownBalls) {
  const TriangleSurface a = ball(10e-3, 1e-3);
  EXPECT_LT(hausdorff_distance(a, a), 1e-12);
  TriangleSurface grown = a, dented = a;
  for (Vec3& v : grown.vertices) v *= 1.05;
  EXPECT_NEAR(hausdorff_distance(a, grown), 0.5e-3, 3e-5);
  // A spike of one vertex is found, whichever surface has it.
  dented.vertices[100] *= 1.3;
  EXPECT_NEAR(hausdorff_distance(a, dented), 3e-3, 1e-4);
  EXPECT_NEAR(hausdorff_distance(dented, a), 3e-3, 1e-4);
}

TEST(Hausdorff, SeesTheMiddleOfATriangle) {
  // Every corner of the flat square lies on the tent's rim; only its middle is far from the tent.
  const TriangleSurface flat = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                {{0, 1, 2}, {0, 2, 3}}};
  const TriangleSurface tent = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.4}},
                                {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  EXPECT_NEAR(farthest_from(flat, tent, SurfaceDistance(tent), 1e-5),
              0.4 * 0.5 / std::hypot(0.5, 0.4), 1e-4);
  EXPECT_NEAR(hausdorff_distance(flat, tent, 1e-5), 0.4, 1e-4);
}

TEST(Hausdorff, CountsOnlyTheRegionWhereOneIsGiven) {
  const TriangleSurface a = ball(10e-3, 1e-3);
  TriangleSurface b = a;
  for (Vec3& v : b.vertices)
    if (v[0] > 0.005) v *= 1.1;
  KeptRegion left, right;
  left.balls.push_back({{-0.01, 0, 0}, 0.008});
  right.balls.push_back({{0.01, 0, 0}, 0.004});
  EXPECT_LT(hausdorff_distance(a, b, 2e-6, &left), 1e-12);
  EXPECT_NEAR(hausdorff_distance(a, b, 2e-6, &right), 1e-3, 2e-4);
}

}  // namespace
}  // namespace genio
