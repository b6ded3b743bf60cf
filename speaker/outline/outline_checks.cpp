#include "speaker/outline/outline_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "speaker/outline/polyline.hpp"

namespace genio {
namespace {

constexpr size_t fewest_points = 12, most_points_of_tongue = 5000;
// Of the tongue's line; the 41 speakers' are 71 to 101 mm across and their lines 200 to 290 mm
// long.
constexpr double smallest_across = 0.035, largest_across = 0.16;  // [m]
constexpr double widest_gap = 0.012;                              // between neighbours [m]
constexpr double widest_opening = 0.05;                           // at the hyoid [m]
constexpr double deepest_crossing = 3e-3;  // of real contours and a palate at closures [m]

void check_crossings(const SpeakerOutline& o) {
  // What closes the line about the hyoid is free: a vallecula hooks behind the straight way there.
  const std::vector<Vec2>& line = o.tongue();
  const size_t sides = line.size() - 1;
  for (size_t i = 0; i < sides; ++i)
    for (size_t k = i + 2; k < sides; ++k)
      if (sides_cross(line[i], line[i + 1], line[k], line[k + 1]))
        throw InputError(fmt::format(
            "{}: segment tongue: the line crosses itself between its {}th and {}th point; expected "
            "a line that does not",
            o.name(), i + 1, k + 1));
}

/// How far above the palate's line a point lies, where the palate is above or below it [m].
void check_palate_above(const SpeakerOutline& o) {
  const Polyline palate(o.segments.at(Segment::palate));
  int above = 0, over = 0;
  size_t worst = 0;
  double most = 0;
  const std::vector<Vec2>& line = o.tongue();
  for (size_t k = 0; k < line.size(); ++k) {
    // The lowest part of the palate above or below this place.
    double lowest = 1e9;
    for (size_t i = 1; i < palate.points().size(); ++i) {
      const Vec2 &a = palate.points()[i - 1], &b = palate.points()[i];
      if ((a[0] - line[k][0]) * (b[0] - line[k][0]) > 0 || a[0] == b[0]) continue;
      const double t = (line[k][0] - a[0]) / (b[0] - a[0]);
      lowest = std::min(lowest, a[1] + t * (b[1] - a[1]));
    }
    if (lowest > 1e8) continue;
    ++over;
    const double depth = line[k][1] - lowest;
    if (depth > deepest_crossing) ++above;
    if (depth > most) most = depth, worst = k;
  }
  // A velum hangs beside the tongue's root, so a part of the line may lie above its end.
  if (over > 0 && 4 * above > over)
    throw InputError(fmt::format(
        "{}: segment palate: lies below the tongue, by {:.1f} mm at the tongue's {}th point; "
        "expected it above",
        o.name(), 1e3 * most, worst + 1));
}

}  // namespace

void check_outline_size(const SpeakerOutline& o) {
  for (const auto& [segment, line] : o.segments) {
    const size_t fewest = segment == Segment::tongue ? fewest_points : 2;
    if (line.size() < fewest)
      throw InputError(fmt::format("{}: segment {}: {} different points; expected {} or more",
                                   o.name(), segment_name(segment), line.size(), fewest));
  }
  const std::vector<Vec2>& line = o.tongue();
  if (line.size() > most_points_of_tongue)
    throw InputError(fmt::format("{}: segment tongue: {} points; expected at most {}", o.name(),
                                 line.size(), most_points_of_tongue));
  Eigen::AlignedBox2d box;
  for (const Vec2& p : line) box.extend(p);
  const double across = box.sizes().norm();
  if (across < smallest_across || across > largest_across)
    throw InputError(fmt::format(
        "{}: segment tongue: is {:.3g} mm across; expected {:g} to {:g} mm: wrong units?", o.name(),
        1e3 * across, 1e3 * smallest_across, 1e3 * largest_across));
  for (size_t k = 1; k < line.size(); ++k)
    if (const double gap = (line[k] - line[k - 1]).norm(); gap > widest_gap)
      throw InputError(fmt::format(
          "{}: segment tongue: a gap of {:.1f} mm between its {}th and {}th point; expected at "
          "most {:g} mm",
          o.name(), 1e3 * gap, k, k + 1, 1e3 * widest_gap));
}

void check_outline(const SpeakerOutline& o) {
  check_outline_size(o);
  const std::vector<Vec2>& line = o.tongue();
  if (!o.free_surface_only)
    if (const double opening = (line.front() - line.back()).norm(); opening > widest_opening)
      throw InputError(fmt::format(
          "{}: segment tongue: is open by {:.0f} mm between its ends; expected it to run from the "
          "hyoid to the vallecula, at most {:g} mm apart",
          o.name(), 1e3 * opening, 1e3 * widest_opening));
  check_crossings(o);
  if (o.has(Segment::palate)) check_palate_above(o);
}

}  // namespace genio
