#include "speaker/modes/recorded_sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/base/median.hpp"
#include "forward/base/thin.hpp"
#include "speaker/outline/polyline.hpp"

namespace genio {
namespace {

constexpr size_t enough_lines = 60, enough_points = 20;
constexpr double at_end = 1e-3;  // from the end of a line that still passes [m]
constexpr double bin = 3e-3;     // of a sweep [m]
constexpr double upper = 0.75;   // of a bin's heights

double mean_distance(const std::vector<Vec2>& points, const Polyline& line) {
  double sum = 0;
  for (const Vec2& p : points) sum += line.foot(p).distance;
  return sum / double(points.size());
}

bool in_turn(const std::vector<Vec2>& points) {
  int forth = 0, back = 0;
  for (size_t k = 1; k < points.size(); ++k) (points[k][0] > points[k - 1][0] ? forth : back) += 1;
  return std::min(forth, back) * 10 <= std::max(forth, back);
}

std::vector<Vec2> line_of(const ContourFrame& frame, bool& sensors) {
  std::vector<Vec2> line;
  for (const ContourPoint& p : frame.points) {
    if (p.kind == "surface" || p.kind == "volume") continue;
    line.emplace_back(p.position[0], p.position[2]);
    sensors = p.kind != "curve";
  }
  return line;
}

}  // namespace

size_t typical_line(const std::vector<std::vector<Vec2>>& lines) {
  std::vector<size_t> numbers(lines.size());
  for (size_t k = 0; k < lines.size(); ++k) numbers[k] = k;
  numbers = thin(numbers, enough_lines);
  std::vector<std::vector<Vec2>> points;
  std::vector<Polyline> drawn;
  for (size_t k : numbers)
    points.push_back(thin(lines[k], enough_points)), drawn.emplace_back(lines[k]);
  size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < numbers.size(); ++i) {
    double sum = 0;
    for (size_t j = 0; j < numbers.size(); ++j)
      sum += mean_distance(points[i], drawn[j]) + mean_distance(points[j], drawn[i]);
    if (sum < least) least = sum, best = numbers[i];
  }
  return best;
}

std::vector<Vec2> middle_line(const std::vector<std::vector<Vec2>>& lines, size_t which) {
  const Polyline typical(lines[which]);
  std::vector<Polyline> others;
  for (const auto& line : thin(lines, enough_lines)) others.emplace_back(line);
  std::vector<Vec2> middle;
  for (size_t k = 0; k < typical.points().size(); ++k) {
    const Vec2 &p = typical.points()[k], along = typical.tangent(typical.arc()[k]);
    const Vec2 across(-along[1], along[0]);
    std::vector<double> offsets;
    for (const Polyline& line : others) {
      const Polyline::Foot foot = line.foot(p);
      const bool inside = foot.s > 0 && foot.s < line.length();
      if (inside || foot.distance < at_end) offsets.push_back(across.dot(foot.place - p));
    }
    if (2 * offsets.size() >= others.size())
      middle.push_back(p + median(std::move(offsets)) * across);
  }
  return middle;
}

std::vector<Vec2> ordered_trace(const std::vector<Vec2>& points) {
  std::vector<Vec2> trace = points;
  if (in_turn(trace)) {
    if (trace.size() > 1 && trace.front()[0] > trace.back()[0])
      std::reverse(trace.begin(), trace.end());
    return trace;
  }
  std::sort(trace.begin(), trace.end(), [](const Vec2& a, const Vec2& b) { return a[0] < b[0]; });
  std::vector<Vec2> result;
  for (size_t first = 0; first < trace.size();) {
    size_t last = first;
    while (last < trace.size() && trace[last][0] <= trace[first][0] + bin) ++last;
    std::vector<Vec2> here(trace.begin() + std::ptrdiff_t(first),
                           trace.begin() + std::ptrdiff_t(last));
    std::sort(here.begin(), here.end(), [](const Vec2& a, const Vec2& b) { return a[1] < b[1]; });
    result.push_back(here[size_t(upper * double(here.size() - 1))]);
    first = last;
  }
  return result;
}

RecordedSight sight_of_recording(const std::vector<ContourFrame>& frames,
                                 const std::vector<Vec2>& palate, double noise) {
  if (palate.size() < 2)
    throw InputError(
        "a speaker's anatomy: expected a palate trace of two points or more (--palate)");
  bool sensors = false;
  std::vector<std::vector<Vec2>> all;
  size_t most = 0;
  for (const ContourFrame& frame : frames) {
    all.push_back(line_of(frame, sensors));
    most = std::max(most, all.back().size());
  }
  // Frames of which a part was lost tell less and lie near others by chance.
  std::vector<std::vector<Vec2>> lines;
  std::vector<int> numbers;
  for (size_t k = 0; k < all.size(); ++k)
    if (all[k].size() >= 2 && 2 * all[k].size() >= most)
      lines.push_back(std::move(all[k])), numbers.push_back(frames[k].number);
  if (lines.empty())
    throw InputError("a speaker's anatomy: no frame has two points of the tongue or more");
  const size_t typical = typical_line(lines);
  RecordedSight result;
  result.frame = numbers[typical];
  result.sight.lines = {{ordered_trace(palate), true, noise, false},
                        {middle_line(lines, typical), false, noise, sensors}};
  return result;
}

}  // namespace genio
