#include "speaker/adaptation/correspondence.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace genio {

double same_place_along(const TongueLandmarks& from, const TongueLandmarks& to, double s) {
  const std::array a = {from.hyoid, from.genial, from.floor, from.tip, from.vallecula};
  const std::array b = {to.hyoid, to.genial, to.floor, to.tip, to.vallecula};
  size_t k = 1;
  while (k + 1 < a.size() && s > a[k]) ++k;
  const double way = a[k] - a[k - 1];
  return way > 0 ? b[k - 1] + (b[k] - b[k - 1]) * (s - a[k - 1]) / way : b[k];
}

std::vector<PlacePair> correspondence(const ModelLine& line, const Positions& x,
                                      const SpeakerOutline& outline, double spacing) {
  const Polyline ours(line.places(x)), theirs(outline.tongue());
  const TongueLandmarks from = line.landmarks(x), to = tongue_landmarks(outline);
  std::vector<double> stops = {from.hyoid, from.genial, from.floor, from.tip, from.vallecula};
  if (outline.free_surface_only) stops.erase(stops.begin(), stops.begin() + 2);
  std::vector<PlacePair> pairs;
  for (size_t k = 1; k < stops.size(); ++k) {
    const int parts = std::max(1, int(std::lround((stops[k] - stops[k - 1]) / spacing)));
    for (int i = k == 1 ? 0 : 1; i <= parts; ++i) {
      const double s = stops[k - 1] + (stops[k] - stops[k - 1]) * i / parts;
      pairs.push_back({ours.at(s), theirs.at(same_place_along(from, to, s))});
    }
  }
  return pairs;
}

}  // namespace genio
