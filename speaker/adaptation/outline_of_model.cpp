#include "speaker/adaptation/outline_of_model.hpp"

#include <algorithm>
#include <cmath>

#include "speaker/adaptation/model_line.hpp"

namespace genio {

SpeakerOutline outline_of_model(const ModelDescription& model,
                                const std::function<Vec2(const Vec2&)>& map, double spacing) {
  const auto drawn = [&](const std::vector<Vec2>& points) {
    const Polyline line(points);
    const int count = std::max(2, int(std::lround(line.length() / spacing)));
    std::vector<Vec2> result;
    for (int k = 0; k <= count; ++k) result.push_back(map(line.at(line.length() * k / count)));
    return result;
  };
  SpeakerOutline outline{model.name, "", {}, false, false, {}};
  outline.segments[Segment::tongue] =
      drawn(model_line(model, model.name).places(rest_positions(model.mesh)));
  for (const auto& [segment, surface] :
       {std::pair{Segment::palate, &model.palate}, {Segment::mandible, &model.jaw}}) {
    if (!*surface) continue;
    const auto cuts = midsagittal_cut(**surface);
    if (!cuts.empty()) outline.segments[segment] = drawn(cuts.front());
  }
  return outline;
}

}  // namespace genio
