// Stacks of contours become closed surfaces that hold what the contours held.

#include "speaker/slices/stack_surface.hpp"
#include "speaker/solid/hausdorff.hpp"
#include "speaker/solid/surface_figures.hpp"
#include "tests/speaker/shapes.hpp"

namespace genio {
namespace {

using test::circle;
using test::complaint;
using test::stack_of;

SurfaceFigures made_of(const ContourStack& stack, double step = 0.4e-3) {
  return surface_figures(stack_surface(stack, step).surface);
}

void expect_ball_like(const SurfaceFigures& f) {
  EXPECT_TRUE(f.closed);
  EXPECT_TRUE(f.manifold);
  EXPECT_EQ(f.euler, 2);
  EXPECT_EQ(f.parts, 1);
}

TEST(Stack, OfCirclesHoldsTheirVolume) {
  const auto r = [](double z) { return 15 + 4 * std::sin(z / 6); };
  std::vector<std::vector<Vec3>> outlines;
  for (int k = 0; k <= 16; ++k) outlines.push_back(circle(30, -5, 2.5 * k, r(2.5 * k)));
  double volume = 0;
  for (int k = 0; k < 40000; ++k)
    volume += std::numbers::pi * std::pow(1e-3 * r((k + 0.5) * 1e-3), 2) * 1e-6;
  const SurfaceFigures f = made_of(stack_of(outlines));
  expect_ball_like(f);
  EXPECT_NEAR(f.volume, volume, 0.002 * volume);
}

TEST(Stack, OfEightPointCirclesIsRoundAllTheSame) {
  const SurfaceFigures f =
      made_of(stack_of({circle(0, 0, 0, 10, 8), circle(0, 0, 10, 10, 8), circle(0, 0, 20, 10, 8)}));
  EXPECT_NEAR(f.volume, 2e-6 * std::numbers::pi, 0.005 * f.volume);
}

TEST(Stack, OfBoxesKeepsItsCorners) {
  const auto square = [](double z) {
    return std::vector<Vec3>{{0, 0, z}, {0.02, 0, z}, {0.02, 0.03, z}, {0, 0.03, z}};
  };
  const SurfaceFigures f = made_of(stack_of({square(0), square(5e-3), square(12e-3)}));
  expect_ball_like(f);
  EXPECT_NEAR(f.volume, 7.2e-6, 0.003 * 7.2e-6);
}

TEST(Stack, ThatSlantsLosesNothing) {
  std::vector<std::vector<Vec3>> outlines;
  for (int k = 0; k <= 8; ++k) outlines.push_back(circle(5.0 * k, 0, 5 * k, 6));  // 45 degrees
  const SurfaceFigures f = made_of(stack_of(outlines));
  expect_ball_like(f);
  EXPECT_NEAR(f.volume, std::numbers::pi * 36 * 40e-9, 0.005 * f.volume);
}

TEST(Stack, OrientationStartAndAxisDoNotMatter) {
  const auto wavy = [](double z) {
    return test::round_outline_at(3, 2, z, 50,
                                  [z](double a) { return 8 + 1.5 * std::cos(3 * a) + 0.1 * z; });
  };
  std::vector<std::vector<Vec3>> outlines, other;
  for (int k = 0; k < 9; ++k) outlines.push_back(wavy(3 * k));
  other = outlines;
  for (size_t k = 0; k < other.size(); ++k) {
    if (k % 2) std::reverse(other[k].begin(), other[k].end());
    std::rotate(other[k].begin(), other[k].begin() + std::ptrdiff_t(7 * k % 50), other[k].end());
    for (Vec3& p : other[k]) p = Vec3(-p[2], p[0], p[1]);  // slices of constant x, falling
  }
  const SurfaceFigures f = made_of(stack_of(outlines)), g = made_of(stack_of(other));
  expect_ball_like(g);
  EXPECT_GT(g.volume, 0);
  EXPECT_NEAR(f.volume, g.volume, 1e-3 * f.volume);
}

TEST(Stack, WithAHoleIsATube) {
  ContourStack stack{{}, "test"};
  for (int k = 0; k < 5; ++k) {
    StackSlice slice{std::to_string(k), {circle(0, 0, 4 * k, 10), circle(1, 0, 4 * k, 5)}};
    if (k % 2) std::reverse(slice.outlines[1].begin(), slice.outlines[1].end());
    stack.slices.push_back(slice);
  }
  const SurfaceFigures f = made_of(stack);
  EXPECT_TRUE(f.closed && f.manifold);
  EXPECT_EQ(f.euler, 0);
  EXPECT_NEAR(f.volume, std::numbers::pi * 75 * 16e-9, 0.005 * f.volume);
}

TEST(Stack, ThatBranchesOrEndsOnOneSideStaysOneBody) {
  ContourStack stack{{}, "test"};
  for (int k = 0; k < 12; ++k) {
    StackSlice slice{std::to_string(k), {}};
    if (k < 4) {
      slice.outlines = {test::round_outline_at(0, 0, 3 * k, 60, [](double a) {
        return 1 / std::hypot(std::cos(a) / 18, std::sin(a) / 6);
      })};
    } else {
      slice.outlines = {circle(12, 0, 3 * k, 5)};
      if (k < 8) slice.outlines.push_back(circle(-12, 0, 3 * k, 5));
    }
    stack.slices.push_back(slice);
  }
  const SurfaceFigures f = made_of(stack);
  expect_ball_like(f);
  // The ellipse for 9 mm, two legs for 12, one for 9; what joins and ends adds the rest.
  const double sure = std::numbers::pi * (108 * 9 + 50 * 9 + 25 * 12);
  EXPECT_GT(f.volume * 1e9, sure);
  EXPECT_LT(f.volume * 1e9, 1.25 * sure);
}

TEST(Stack, OfSlicesThroughAJawFindsTheJaw) {
  // The outlines are cut from a body that is known, 2 mm apart, across the branches.
  const TriangleSurface jaw = test::jaw_like(1e-3);
  ContourStack stack{{}, "test"};
  for (double x = -4.4e-3; x < 89e-3; x += 2e-3) {
    TriangleSurface turned = jaw;
    for (Vec3& v : turned.vertices) v = Vec3(v[1], v[0] - x, v[2]);
    StackSlice slice{std::to_string(x), {}};
    for (const auto& line : midsagittal_cut(turned)) {
      std::vector<Vec3> outline;
      for (const auto& p : line)
        if (const Vec3 at(x, p[0], p[1]); outline.empty() || (at - outline.back()).norm() > 0.2e-3)
          outline.push_back(at);
      while (outline.size() > 1 && (outline.front() - outline.back()).norm() < 0.2e-3)
        outline.pop_back();
      if (outline.size() > 8) slice.outlines.push_back(outline);
    }
    if (!slice.outlines.empty()) stack.slices.push_back(slice);
  }
  ASSERT_GT(stack.slices.size(), 40u);
  const TriangleSurface found = stack_surface(stack, 0.8e-3).surface;
  const SurfaceFigures f = surface_figures(found), g = surface_figures(jaw);
  expect_ball_like(f);
  EXPECT_NEAR(f.volume, g.volume, 0.02 * g.volume);
  // Where the bone runs along the slices, what lies between two of them is anyone's guess: the
  // surface may be off by two distances of slices.
  EXPECT_LT(farthest_from(found, jaw, SurfaceDistance(jaw), 1e-5), 4e-3);
}

std::string table(const std::vector<std::vector<Vec3>>& outlines, double unit = 1e3) {
  std::string text = "slice,point,x_mm,y_mm,z_mm\n";
  for (size_t k = 0; k < outlines.size(); ++k)
    for (size_t i = 0; i < outlines[k].size(); ++i) {
      const Vec3 p = unit * outlines[k][i];
      text += std::to_string(k + 1) + "," + std::to_string(i + 1) + "," + std::to_string(p[0]) +
              "," + std::to_string(p[1]) + "," + std::to_string(p[2]) + "\n";
    }
  return text;
}

std::string stack_complaint(const std::string& text) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("s.csv", text);
  const std::string said = complaint([&] { stack_surface(read_contour_stack(path), 1e-3); });
  EXPECT_EQ(said.find('\n'), std::string::npos);
  return said;
}

TEST(StackFile, ThatIsAsItShouldBeIsRead) {
  const test::ScratchFolder folder;
  auto closed = circle(0, 0, 0, 9.5);
  closed.push_back(closed.front());
  const auto stack =
      read_contour_stack(folder.write("s.csv", table({closed, circle(0, 0, 4, 9.5)})));
  ASSERT_EQ(stack.slices.size(), 2u);
  EXPECT_EQ(stack.slices[0].outlines[0].size(), 40u);  // the repeated point is no point
  EXPECT_EQ(stack_complaint(table({closed, circle(0, 0, 4, 9.5)})), "");
}

TEST(StackFile, SeveralOutlinesASliceByColumnOrByCount) {
  const test::ScratchFolder folder;
  const std::string counted =
      "slice;point;x_mm;y_mm;z_mm\n1;1;0;0;0\n1;2;5;0;0\n1;3;0;5;0\n1;1;9;0;0\n1;2;19,5;0;0\n"
      "1;3;9;5;0\n2;1;0;0;3\n2;2;5;0;3\n2;3;0;5;3\n";
  EXPECT_EQ(read_contour_stack(folder.write("a.csv", counted)).slices[0].outlines.size(), 2u);
  const std::string named =
      "slice,contour,point,x_mm,y_mm,z_mm\n1,a,1,0,0,0\n1,a,2,5,0,0\n1,a,3,0,5,0\n1,b,4,9,0,0\n"
      "1,b,5,19,0,0\n1,b,6,9,5,0\n2,a,1,0,0,3\n2,a,2,5,0,3\n2,a,3,0,5,3\n";
  EXPECT_EQ(read_contour_stack(folder.write("b.csv", named)).slices[0].outlines.size(), 2u);
}

TEST(StackFile, FaultsAreNamed) {
  const auto a = circle(0, 0, 0, 9.5), b = circle(0, 0, 4, 9.5), c = circle(0, 0, 8, 9.5);
  const auto says = [](const std::vector<std::vector<Vec3>>& outlines, const char* what,
                       double unit = 1e3) {
    const std::string said = stack_complaint(table(outlines, unit));
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  says({a, {b[0], b[1]}}, "slice '2': an outline of 2 points; expected 3 or more");
  says({a, c, b}, "slice '3': lies back behind slice '2'");
  says({a, b, b}, "slice '3': lies at the height of slice '2'");
  says({a, b}, "expected millimetres, not metres", 1);
  says({a, b}, "expected millimetres of a head, not pixels", 5e4);
  says({a}, "1 slice; expected 2 or more");
  auto crossed = b;
  std::swap(crossed[3], crossed[20]);
  says({a, crossed, c}, "slice '2': an outline crosses or touches itself near point");
  auto bent = b;
  bent[5][2] += 3e-3;
  says({a, bent, c}, "slice '2': a point lies");
  says({a, {b[0], (b[0] + b[7]) / 2, b[7]}}, "slice '2': an outline has no area");
  std::string pixels = "slice,point,x_mm,y_mm,z_mm\n";
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 50; ++i)
      pixels += fmt::format("{},{},{},{},{}\n", k, i, i < 25 ? 100 + i : 149 - i,
                            i < 25 ? 200 : 230, 2.5 * k);
  EXPECT_NE(stack_complaint(pixels).find("whole numbers"), std::string::npos);
  ContourStack two = stack_of({a, b});
  two.slices[1].outlines.push_back(circle(8, 0, 4, 9));
  EXPECT_NE(complaint([&] { stack_surface(two, 1e-3); }).find("two outlines cross"),
            std::string::npos);
}

TEST(StackFile, RowsThatCannotBeAreRefusedByLine) {
  const std::string head = "slice,point,x_mm,y_mm,z_mm\n1,1,0,0,0\n1,2,5,0,0\n";
  const auto says = [](const std::string& text, const char* what) {
    const std::string said = stack_complaint(text);
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  says("slice,point,x,y,z\n1,1,0,0,0\n", "s.csv:1: no column x_mm");
  says(head + "1,3,0,five,0\n", "s.csv:4: column y_mm");
  says(head + "1,3,0,0\n", "s.csv:4:");
  says(head + "1,5,0,5,0\n1,4,0,6,0\n", "s.csv:5: column point: 4 does not follow 5");
  says(head + "1,3,0,1e30,0\n", "out of all range");
  says(head + "1,3,0,5,0\n2,1,0,0,3\n2,2,5,0,3\n2,3,0,5,3\n1,4,2,2,0\n", "slice '1' comes again");
  says("", "the file is empty");
}

}  // namespace
}  // namespace genio
