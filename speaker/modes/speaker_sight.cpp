#include "speaker/modes/speaker_sight.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "speaker/outline/rigid_frame.hpp"

namespace genio {
namespace {

constexpr double far_better = 8;  // in log odds
constexpr double joint = 3e-3;    // over which an estimated palate goes over into a trace [m]

SpeakerSight mirrored_sight(SpeakerSight sight) {
  for (SightedLine& line : sight.lines)
    for (Vec2& p : line.points) p[0] = -p[0];
  return sight;
}

double mean_height(const std::vector<SightedLine>& lines, bool palate) {
  double sum = 0;
  size_t count = 0;
  for (const SightedLine& line : lines)
    if (line.palate == palate)
      for (const Vec2& p : line.points) sum += p[1], ++count;
  return count ? sum / double(count) : 0;
}

}  // namespace

SpeakerSight sight_of_files(const SightFiles& files) {
  SpeakerOutline palate;
  read_outline_palate(files.palate, palate);
  SpeakerSight sight;
  sight.lines.push_back({palate.segments.at(Segment::palate), true, files.noise});
  for (auto& line : read_outline_lines(files.contours))
    sight.lines.push_back({std::move(line), false, files.noise});
  return sight;
}

AnatomyEstimate estimate_as_it_faces(const OutlineModes& modes, const SpeakerSight& sight,
                                     const std::string& source) {
  if (mean_height(sight.lines, false) > mean_height(sight.lines, true))
    throw InputError(fmt::format(
        "{}: lies above the palate; expected both in one frame with the second coordinate up",
        source));
  const AnatomyEstimate here = estimate_anatomy(modes, sight);
  const AnatomyEstimate turned = estimate_anatomy(modes, mirrored_sight(sight));
  if (turned.cost < here.cost - far_better)
    throw InputError(
        fmt::format("{}: palate and tongue are far more like those of a face that looks the other "
                    "way (by {:.0f} "
                    "log odds); expected x to point backwards",
                    source, here.cost - turned.cost));
  return here;
}

SpeakerOutline sighted_outline(const AnatomyEstimate& estimate, const SpeakerSight& sight,
                               const std::string& source) {
  SpeakerOutline outline = outline_through(estimate.places, source);
  std::vector<Vec2>& palate = outline.segments.at(Segment::palate);
  for (const SightedLine& line : sight.lines) {
    if (!line.palate || line.points.size() < 2) continue;
    std::vector<Vec2> trace = line.points;
    if (trace.front()[0] > trace.back()[0]) std::reverse(trace.begin(), trace.end());
    std::erase_if(palate, [&](const Vec2& p) { return p[0] > trace.front()[0] - joint; });
    palate.insert(palate.end(), trace.begin(), trace.end());
  }
  // Upright, as the speakers stand that the modes are of.
  Similarity upright;
  upright.angle = -estimate.pose.angle;
  upright.shift = -upright(estimate.pose.shift);
  return moved_outline(std::move(outline), upright);
}

AnatomyEstimate estimate_of_outline(const OutlineModes& modes, const SpeakerOutline& outline) {
  SpeakerSight sight;
  sight.points = outline_points(outline);
  return estimate_anatomy(modes, sight);
}

}  // namespace genio
