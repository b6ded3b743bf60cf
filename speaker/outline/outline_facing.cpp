#include "speaker/outline/outline_facing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "speaker/outline/polyline.hpp"

namespace genio {
namespace {

constexpr double certain_way = 5e-3;    // between what lies in front and behind [m]
constexpr double smallest_loop = 5e-3;  // shorter ones are a tracing's [m]

Vec2 middle_place(const std::vector<Vec2>& points) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& p : points) sum += p;
  return sum / double(points.size());
}

/// How far what lies behind is along +x from what lies in front, by the bones; empty without them.
std::optional<double> backwards_by_bones(const SpeakerOutline& o) {
  double front = 0, behind = 0;
  int fronts = 0, behinds = 0;
  for (const auto& [segment, points] : o.segments) {
    if (segment == Segment::mandible) front += middle_place(points)[0], ++fronts;
    if (segment == Segment::pharynx || segment == Segment::epiglottis || segment == Segment::hyoid)
      behind += middle_place(points)[0], ++behinds;
  }
  if (o.has(Segment::palate) && !fronts) {
    // Of a palate alone the middle stands for the front: what is behind it lies behind all of it.
    front += middle_place(o.segments.at(Segment::palate))[0], ++fronts;
  }
  if (!fronts || !behinds) return std::nullopt;
  return behind / behinds - front / fronts;
}

void mirror_outline(SpeakerOutline& o) {
  for (auto& [segment, points] : o.segments)
    for (Vec2& p : points) p[0] = -p[0];
}

/// Whether x must be mirrored. Throws InputError where that is not certain.
bool faces_away(const SpeakerOutline& o) {
  if (const auto way = backwards_by_bones(o)) {
    if (std::abs(*way) < certain_way)
      throw InputError(
          fmt::format("{}: the bones do not tell which way the face looks; expected "
                      "the pharynx or hyoid behind the mandible or palate",
                      o.name()));
    return *way < 0;
  }
  const std::vector<Vec2>& line = o.tongue();
  const auto [low, high] = std::minmax_element(
      line.begin(), line.end(), [](const Vec2& a, const Vec2& b) { return a[0] < b[0]; });
  const double centre = 0.5 * ((*low)[0] + (*high)[0]);
  const double ends = 0.5 * (line.front()[0] + line.back()[0]) - centre;
  if (!o.free_surface_only && std::abs(ends) > certain_way) return ends < 0;
  // A free surface runs from front to back; the other order would be the other facing.
  if (line.front()[0] < line.back()[0] - certain_way) return false;
  throw InputError(fmt::format(
      "{}: segment tongue: runs from larger to smaller x, so it faces the other way or "
      "is written from its root; expected x backwards and the floor of the mouth first, "
      "or bones that tell",
      o.name()));
}

/// Leaves out what lies between two crossing sides of the tongue's line that are near along it:
/// tracings double back on themselves where they end or touch a bone.
void cut_small_loops(SpeakerOutline& o) {
  std::vector<Vec2>& line = o.segments.at(Segment::tongue);
  for (size_t i = 0; i + 3 < line.size(); ++i) {
    double along = 0;
    for (size_t k = i + 2; k + 1 < line.size(); ++k) {
      along += (line[k] - line[k - 1]).norm();
      if (along > smallest_loop) break;
      if (!sides_cross(line[i], line[i + 1], line[k], line[k + 1])) continue;
      line.erase(line.begin() + std::ptrdiff_t(i) + 1, line.begin() + std::ptrdiff_t(k) + 1);
      o.notes.push_back(fmt::format(
          "A loop of the tongue's line of {:.1f} mm behind its {}th point was left out.",
          1e3 * along, i + 1));
      break;
    }
  }
}

}  // namespace

SpeakerOutline facing_model(SpeakerOutline o) {
  if (faces_away(o)) {
    mirror_outline(o);
    o.mirrored = true;
    o.notes.push_back("The outline faced the other way and was mirrored.");
  }
  std::vector<Vec2>& line = o.segments.at(Segment::tongue);
  cut_small_loops(o);
  if (o.has(Segment::palate) &&
      middle_place(o.segments.at(Segment::palate))[1] < middle_place(line)[1])
    throw InputError(fmt::format(
        "{}: segment palate: lies below the tongue; expected y (or z) upwards", o.name()));
  // From below over the front to the top the line runs clockwise with x backwards.
  if (doubled_area(line) > 0) {
    std::reverse(line.begin(), line.end());
    o.notes.push_back("The tongue's line was written from its root and was turned about.");
  }
  const auto [low, high] = std::minmax_element(
      line.begin(), line.end(), [](const Vec2& a, const Vec2& b) { return a[0] < b[0]; });
  const double centre = 0.5 * ((*low)[0] + (*high)[0]);
  if (!o.free_surface_only && line.front()[0] < centre) {
    o.free_surface_only = true;
    o.notes.push_back(
        "The tongue's line begins in front, so it was taken for the free surface alone.");
  }
  if (line.back()[0] < centre)
    throw InputError(fmt::format(
        "{}: segment tongue: its last point lies in front; expected it to end at the root",
        o.name()));
  if (!o.has(Segment::palate) && !o.free_surface_only && line.front()[1] > line.back()[1])
    throw InputError(fmt::format(
        "{}: segment tongue: the end at the hyoid lies above the end at the root, so the outline "
        "stands on its head; expected y (or z) upwards",
        o.name()));
  return o;
}

}  // namespace genio
