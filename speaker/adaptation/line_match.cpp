#include "speaker/adaptation/line_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace genio {
namespace {

constexpr double longest_slide = 4e-3;  // at once [m]
constexpr int most_slides = 20;
constexpr double least_lead = 12e-3;  // along which a notch leads places into it [m]
constexpr double slide_end = 2e-5;    // of the place that slid farthest [m]

/// The outline's arc length at the same part of the way between the same two landmarks.
double same_place_along(const TongueLandmarks& from, const TongueLandmarks& to, double s) {
  const std::array a = {from.hyoid, from.genial, from.floor, from.tip, from.vallecula};
  const std::array b = {to.hyoid, to.genial, to.floor, to.tip, to.vallecula};
  size_t k = 1;
  while (k + 1 < a.size() && s > a[k]) ++k;
  const double way = a[k] - a[k - 1];
  return way > 0 ? b[k - 1] + (b[k] - b[k - 1]) * (s - a[k - 1]) / way : b[k];
}

/// The value at `s` of what has the values `to` at `from`, straight between them and beyond.
double between(const std::vector<double>& from, const std::vector<double>& to, double s) {
  size_t k = 1;
  while (k + 1 < from.size() && s > from[k]) ++k;
  const double way = from[k] - from[k - 1];
  return way > 0 ? to[k - 1] + (to[k] - to[k - 1]) * (s - from[k - 1]) / way : to[k];
}

}  // namespace

std::vector<PlacePair> LineMatch::pairs(const Polyline& outline) const {
  std::vector<PlacePair> result;
  for (size_t k = 0; k < from.size(); ++k) result.push_back({from[k], outline.at(at[k])});
  return result;
}

double LineMatch::to_outline(double position) const { return between(node, at, position); }
double LineMatch::to_line(double s) const { return between(at, node, s); }

void LineMatch::lead_into_notch() {
  if (!notch) return;
  const double middle = to_outline(double(notch->node)), off = notch->at - middle;
  const double reach = std::max(least_lead, 1.5 * std::abs(off));
  for (double& s : at) s += off * std::max(0.0, 1 - std::abs(s - middle) / reach);
}

LineMatch match_by_landmarks(const ModelLine& line, const Positions& rest,
                             const SpeakerOutline& outline, double spacing) {
  const Polyline ours(line.places(rest));
  const TongueLandmarks from = line.landmarks(rest), to = tongue_landmarks(outline);
  std::vector<double> stops = {from.hyoid, from.genial, from.floor, from.tip, from.vallecula};
  if (outline.free_surface_only) stops.erase(stops.begin(), stops.begin() + 2);
  LineMatch match;
  if (to.notch > 0)
    match.notch = LineMatch::Notch{
        size_t(std::lround(ours.position(deepest_notch(ours, from.floor, from.tip)))), to.notch};
  for (size_t k = 1; k < stops.size(); ++k) {
    const int parts = std::max(1, int(std::lround((stops[k] - stops[k - 1]) / spacing)));
    for (int i = k == 1 ? 0 : 1; i <= parts; ++i) {
      const double s = stops[k - 1] + (stops[k] - stops[k - 1]) * i / parts;
      match.from.push_back(ours.at(s));
      match.node.push_back(ours.position(s));
      match.at.push_back(same_place_along(from, to, s));
    }
  }
  return match;
}

ThinPlateMap slid_map(LineMatch& match, const Polyline& outline, ThinPlateMap map,
                      double smoothing) {
  for (int round = 0; round < most_slides; ++round) {
    double farthest = 0;
    std::vector<SlidingPair> pairs;
    for (size_t k = 0; k < match.from.size(); ++k) {
      double& s = match.at[k];
      const bool end = k == 0 || k + 1 == match.from.size();
      if (!end) {
        const double before = s;
        s = outline
                .foot(map(match.from[k]), std::max(s - longest_slide, match.at[k - 1]),
                      s + longest_slide)
                .s;
        farthest = std::max(farthest, std::abs(s - before));
      }
      pairs.push_back({match.from[k], outline.at(s), end ? Vec2(0, 0) : outline.tangent(s)});
    }
    map = ThinPlateMap(pairs, smoothing);
    if (farthest < slide_end) break;
  }
  return map;
}

}  // namespace genio
