#include "speaker/modes/outline_points.hpp"

#include <algorithm>
#include <numeric>

#include "speaker/outline/rigid_frame.hpp"
#include "speaker/outline/tongue_landmarks.hpp"

namespace genio {
namespace {

constexpr double palate_step = 3.5e-3;  // from the incisors' edge on [m]
const std::vector<std::string> tongue_stretches = {"floor", "mandible", "mouth_floor", "surface"};

std::vector<OutlineStretch> laid_out() {
  std::vector<OutlineStretch> all;
  int first = 0;
  for (const auto& [name, count] : {std::pair{"floor", 12},
                                    {"mandible", 6},
                                    {"mouth_floor", 10},
                                    {"surface", 31},
                                    {"palate", 21},
                                    {"hyoid", 1},
                                    {"pharynx", 9}})
    all.push_back({name, first, count}), first += count;
  return all;
}

/// Places at equal parts of a line's length between two arc lengths; the last one only where
/// `closed`.
void fill(const Polyline& line, double from, double to, bool closed, const OutlineStretch& s,
          OutlinePoints& points) {
  for (int k = 0; k < s.count; ++k) {
    const double part = double(k) / double(closed ? s.count - 1 : s.count);
    points.places[size_t(s.first + k)] = line.at(from + part * (to - from));
    points.known[size_t(s.first + k)] = true;
  }
}

/// Places at fixed lengths from the incisors: where a flat arch has its top is chance.
void fill_palate(const std::vector<Vec2>& underside, OutlinePoints& points) {
  if (underside.empty()) return;
  const Polyline line(underside);
  const OutlineStretch& s = outline_stretch("palate");
  for (int k = 0; k < s.count && k * palate_step <= line.length(); ++k)
    points.places[size_t(s.first + k)] = line.at(k * palate_step),
                                   points.known[size_t(s.first + k)] = true;
}

}  // namespace

const std::vector<OutlineStretch>& outline_stretches() {
  static const std::vector<OutlineStretch> all = laid_out();
  return all;
}

const OutlineStretch& outline_stretch(const std::string& name) {
  const auto& all = outline_stretches();
  return *std::find_if(all.begin(), all.end(),
                       [&](const OutlineStretch& s) { return s.name == name; });
}

int outline_point_count() {
  const OutlineStretch& last = outline_stretches().back();
  return last.first + last.count;
}

OutlinePoints outline_points(const SpeakerOutline& outline) {
  OutlinePoints points{std::vector<Vec2>(size_t(outline_point_count()), Vec2::Zero()),
                       std::vector<bool>(size_t(outline_point_count()), false)};
  const Polyline line(outline.tongue());
  const TongueLandmarks marks = tongue_landmarks(outline);
  fill(line, marks.tip, marks.vallecula, true, outline_stretch("surface"), points);
  fill(line, marks.floor, marks.tip, false, outline_stretch("mouth_floor"), points);
  if (!outline.free_surface_only) {
    fill(line, marks.hyoid, marks.genial, false, outline_stretch("floor"), points);
    fill(line, marks.genial, marks.floor, false, outline_stretch("mandible"), points);
  }
  if (outline.has(Segment::palate))
    fill_palate(underside_of_palate(outline.segments.at(Segment::palate)), points);
  if (outline.has(Segment::hyoid)) {
    const auto& hyoid = outline.segments.at(Segment::hyoid);
    const auto at = size_t(outline_stretch("hyoid").first);
    points.places[at] =
        std::accumulate(hyoid.begin(), hyoid.end(), Vec2(Vec2::Zero())) / double(hyoid.size());
    points.known[at] = true;
  }
  if (outline.has(Segment::pharynx) && outline.segments.at(Segment::pharynx).size() > 1) {
    const Polyline wall(outline.segments.at(Segment::pharynx));
    const bool upwards = wall.points().back()[1] > wall.points().front()[1];
    fill(wall, upwards ? 0 : wall.length(), upwards ? wall.length() : 0, true,
         outline_stretch("pharynx"), points);
  }
  return points;
}

Vector stacked_places(const OutlinePoints& points) {
  Vector column = Vector::Zero(2 * Eigen::Index(points.places.size()));
  for (size_t i = 0; i < points.places.size(); ++i)
    if (points.known[i]) column.segment<2>(2 * Eigen::Index(i)) = points.places[i];
  return column;
}

SpeakerOutline outline_through(const std::vector<Vec2>& places, const std::string& source) {
  SpeakerOutline outline;
  outline.source = source;
  const auto append = [&](const std::string& name, std::vector<Vec2>& line) {
    const OutlineStretch& s = outline_stretch(name);
    line.insert(line.end(), places.begin() + s.first, places.begin() + s.first + s.count);
  };
  for (const std::string& name : tongue_stretches) append(name, outline.segments[Segment::tongue]);
  append("palate", outline.segments[Segment::palate]);
  append("pharynx", outline.segments[Segment::pharynx]);
  return outline;
}

}  // namespace genio
