#include "speaker/modes/recorded_sight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace genio {
namespace {

/// An arc of the tongue, raised and with noise, from one part of it to another.
std::vector<Vec2> arc(double raised, double from = 0, double to = 1) {
  std::vector<Vec2> line;
  for (int k = 0; k <= 30; ++k) {
    const double t = std::numbers::pi * (from + (to - from) * k / 30);
    line.emplace_back(0.06 - 0.035 * std::cos(t), 0.09 + raised + 0.025 * std::sin(t));
  }
  return line;
}

ContourFrame frame_of(int number, const std::vector<Vec2>& line, const std::string& kind) {
  ContourFrame frame;
  frame.number = number;
  for (const Vec2& p : line) frame.points.push_back({Vec3(p[0], 0, p[1]), 0, kind});
  return frame;
}

TEST(RecordedSights, TheTypicalLineLiesAmongTheOthers) {
  const std::vector<std::vector<Vec2>> lines = {arc(-4e-3), arc(-1e-3), arc(0.5e-3), arc(9e-3),
                                                arc(2e-3)};
  EXPECT_EQ(typical_line(lines), 2u);
  EXPECT_EQ(typical_line({arc(0)}), 0u);
}

TEST(RecordedSights, TheMiddleOfNoisyLinesIsLessNoisy) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1e-3);
  std::vector<std::vector<Vec2>> lines;
  for (int k = 0; k < 40; ++k) {
    lines.push_back(arc(0));
    for (Vec2& p : lines.back()) p += Vec2(noise(random), noise(random));
  }
  const auto off = [](const std::vector<Vec2>& line) {
    double square = 0;
    for (const Vec2& p : line) {
      const Vec2 q(-(p[0] - 0.06) / 0.035, (p[1] - 0.09) / 0.025);
      square += std::pow((q.norm() - 1) * 0.03, 2);
    }
    return std::sqrt(square / double(line.size()));
  };
  const size_t typical = typical_line(lines);
  EXPECT_LT(off(middle_line(lines, typical)), 0.6 * off(lines[typical]));
}

TEST(RecordedSights, TheMiddleEndsWhereHalfOfTheLinesEnd) {
  const std::vector<std::vector<Vec2>> lines = {arc(0), arc(0, 0.3, 1), arc(1e-4, 0.3, 1),
                                                arc(-1e-4, 0.3, 1)};
  const std::vector<Vec2> middle = middle_line(lines, typical_line(lines));
  const double begin = 0.06 - 0.035 * std::cos(0.3 * std::numbers::pi);
  for (const Vec2& p : middle) EXPECT_GT(p[0], begin - 2e-3);
}

TEST(RecordedSights, ATraceRunsFromFrontToBackAsItIs) {
  std::vector<Vec2> trace = arc(0, 0.2, 0.9);
  EXPECT_EQ(ordered_trace(trace), trace);
  const std::vector<Vec2> forth = trace;
  std::reverse(trace.begin(), trace.end());
  EXPECT_EQ(ordered_trace(trace), forth);
}

TEST(RecordedSights, ASweepGivesThePalateAndNotTheWayBack) {
  std::vector<Vec2> sweep;
  for (int pass = 0; pass < 3; ++pass) {
    for (const Vec2& p : arc(0, 0.1, 0.9)) sweep.push_back(p);
    auto back = arc(pass == 1 ? -8e-3 : 0, 0.1, 0.9);  // once the sensor lost the palate
    std::reverse(back.begin(), back.end());
    sweep.insert(sweep.end(), back.begin(), back.end());
  }
  const std::vector<Vec2> trace = ordered_trace(sweep);
  ASSERT_GT(trace.size(), 10u);
  for (size_t k = 1; k < trace.size(); ++k) EXPECT_LT(trace[k - 1][0], trace[k][0]);
  for (const Vec2& p : trace) {
    const double height = 0.025 * std::sqrt(1 - std::pow((p[0] - 0.06) / 0.035, 2));
    EXPECT_NEAR(p[1], 0.09 + height, 1e-3);
  }
}

TEST(RecordedSights, SensorsArePointsAndContoursAreLines) {
  const std::vector<Vec2> palate = arc(15e-3, 0.2, 0.9);
  const auto contours = sight_of_recording(
      {frame_of(4, arc(0), "curve"), frame_of(5, {Vec2(0.06, 0.1)}, "curve")}, palate, 1e-3);
  EXPECT_EQ(contours.frame, 4);
  ASSERT_EQ(contours.sight.lines.size(), 2u);
  EXPECT_TRUE(contours.sight.lines[0].palate);
  EXPECT_FALSE(contours.sight.lines[1].at_points);
  const auto sensors = sight_of_recording({frame_of(1, arc(0), "tip")}, palate, 1e-3);
  EXPECT_TRUE(sensors.sight.lines[1].at_points);
}

TEST(RecordedSights, WithoutTongueOrPalateARecordingIsRefused) {
  EXPECT_THROW(sight_of_recording({frame_of(1, {}, "curve")}, arc(0.015), 1e-3), InputError);
  EXPECT_THROW(sight_of_recording({frame_of(1, arc(0), "curve")}, {}, 1e-3), InputError);
}

}  // namespace
}  // namespace genio
