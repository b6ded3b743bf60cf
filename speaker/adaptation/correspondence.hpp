#pragma once
#include "speaker/adaptation/model_line.hpp"
#include "speaker/outline/thin_plate.hpp"

namespace genio {

/// Places of the model's midsagittal line in the shape `x`, `spacing` apart [m], with those of the
/// outline's tongue that lie at the same part of the way between the same two landmarks: hyoid,
/// genial, floor, tip and vallecula. The landmarks themselves are among them. Of an outline that is
/// a free surface alone only the part from the floor to the vallecula.
std::vector<PlacePair> correspondence(const ModelLine& line, const Positions& x,
                                      const SpeakerOutline& outline, double spacing);

/// The outline's arc length that stands for each landmark's own way between its neighbours: takes
/// an arc length of the model's line to one of the outline's.
double same_place_along(const TongueLandmarks& from, const TongueLandmarks& to, double s);

}  // namespace genio
