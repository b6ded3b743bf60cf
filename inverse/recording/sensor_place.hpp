#pragma once
// Where a sensor is glued: a landmark of the tongue, a node, or a length along its midsagittal
// line.

#include <map>

#include "forward/model/model.hpp"
#include "inverse/recording/base/contours.hpp"

namespace genio {

/// A sensor's place as text: "tip", "blade", "dorsum", "root", "node:N", each with or without a
/// length behind it along the midsagittal line of the tongue at rest, "tip+13mm" ("-": in front of
/// it). The weights of nodes whose weighted positions are the place's. Throws InputError that
/// names what there is.
std::vector<std::pair<int, double>> sensor_place(const Model& model, const std::string& place);

/// Its arc length behind the tip at rest [m]; of a node off the midsagittal line NaN.
double behind_tip(const Model& model, const std::string& place);

/// Scales that speakers have beside a model.
inline constexpr std::pair any_scale{0.75, 1.3};

/// What no tissue is stretched by as a whole, and what it seldom is.
inline constexpr double most_stretch = 0.3, usual_stretch = 0.15;

/// What contradicts the places, empty where nothing does: two sensors whose distance, over all
/// frames, no scale between those and no such stretch of the tissue brings to the model's; two
/// that lie in the other order along the head; two at one place that lie apart. It names the two
/// and places that fit. x runs back [m].
std::string place_contradiction(const Model& model, const ContourFile& file,
                                const std::pair<double, double>& scales = any_scale,
                                double stretch = most_stretch);

/// Places that fit the sensors' mutual distances: sensors in the order in which they lie behind the
/// tip, the first about 10 mm behind it, each next by its usual distance from the one before. Of
/// kind to arc length behind the tip [m].
std::map<std::string, double> places_by_distance(const Model& model, const ContourFile& file);

}  // namespace genio
