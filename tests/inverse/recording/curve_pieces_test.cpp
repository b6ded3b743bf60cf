// A frame is one curve: two takes in one are refused, and a root far below the dorsum is none.

#include "inverse/recording/base/curve_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "forward/base/types.hpp"

namespace genio {
namespace {

/// Points of an arc, from `first` to `last` degrees above the front, `higher` mm farther out.
std::vector<ContourPoint> arc(double first, double last, double higher = 0) {
  std::vector<ContourPoint> points;
  for (double at = first; at <= last; at += 3) {
    const double angle = at * std::numbers::pi / 180, radius = 0.035 + 1e-3 * higher;
    points.push_back(
        {.position = {-radius * std::cos(angle), 0, radius * std::sin(angle)}, .kind = "curve"});
  }
  return points;
}

std::vector<ContourPoint> operator+(std::vector<ContourPoint> a,
                                    const std::vector<ContourPoint>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

ContourFile file_of(std::vector<std::vector<ContourPoint>> frames) {
  ContourFile file;
  for (auto& points : frames) {
    ContourFrame frame;
    frame.number = int(file.frames.size()) + 1, frame.points = std::move(points);
    file.frames.push_back(std::move(frame));
  }
  return file;
}

TEST(OneCurveAFrame, RootBelowTheDorsumBehindAGapIsOfTheCurve) {
  // The root comes forward again, so that it lies below what was traced of the dorsum.
  std::vector<ContourPoint> root;
  for (int k = 0; k < 7; ++k)
    root.push_back({.position = {0.030 - 1e-3 * k, 0, -0.022 - 2e-3 * k}, .kind = "curve"});
  const auto file = with_one_curve_a_frame(file_of({arc(20, 179) + root}), "a.tsv");
  EXPECT_EQ(file.frames[0].points.size(), arc(20, 179).size() + root.size());
  EXPECT_TRUE(file.remarks.empty());
}

TEST(OneCurveAFrame, TwoTakesInOneAreRefused) {
  for (double higher : {2.0, 8.0})
    for (bool back : {false, true}) {
      auto second = arc(25, 160, higher);
      if (back) std::reverse(second.begin(), second.end());
      if (back) second.erase(second.begin(), second.begin() + 10);  // else the ends meet
      EXPECT_THROW(with_one_curve_a_frame(file_of({arc(20, 170) + second}), "a.tsv"), InputError)
          << higher << back;
    }
}

TEST(OneCurveAFrame, PaddingIsNoneOfTheCurve) {
  auto points = arc(20, 170);
  const size_t size = points.size();
  points.resize(size + 5, {.position = Vec3::Zero(), .kind = "curve"});
  const auto file = with_one_curve_a_frame(file_of({points}), "a.tsv");
  EXPECT_EQ(file.frames[0].points.size(), size);
  ASSERT_EQ(file.remarks.size(), 1u);
  EXPECT_NE(file.remarks[0].find("as padding: 5"), std::string::npos);
  // A last point that is repeated is one itself.
  points = arc(20, 170);
  points.resize(size + 5, points.back());
  EXPECT_EQ(with_one_curve_a_frame(file_of({points}), "a.tsv").frames[0].points.size(), size);
  // A frame of padding says why it has no points.
  const std::vector<ContourPoint> zeros(9, {.position = Vec3::Zero(), .kind = "curve"});
  const auto empty = with_one_curve_a_frame(file_of({arc(20, 170), zeros}), "a.tsv");
  EXPECT_TRUE(empty.frames[1].points.empty());
  EXPECT_FALSE(empty.frames[1].note.empty());
}

TEST(OneCurveAFrame, OneOddFrameCostsNoOther) {
  std::vector<std::vector<ContourPoint>> frames(20, arc(20, 170));
  frames[6] = arc(20, 170) + arc(25, 160, 5);
  const auto file = with_one_curve_a_frame(file_of(frames), "a.tsv");
  EXPECT_TRUE(file.frames[6].points.empty());
  EXPECT_NE(file.frames[6].note.find("two takes in one frame?"), std::string::npos);
  EXPECT_EQ(file.frames[7].points.size(), arc(20, 170).size());
  ASSERT_EQ(file.remarks.size(), 1u);
  EXPECT_NE(file.remarks[0].find("1 of 20, the first is frame 7"), std::string::npos);
}

}  // namespace
}  // namespace genio
