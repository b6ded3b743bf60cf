#pragma once
#include <functional>

#include "forward/effects/description.hpp"
#include "speaker/outline/outline.hpp"

namespace genio {

/// The midsagittal outline that a model has itself, after a map of the plane: the tongue's line
/// with its floor, and the cuts of palate and mandible. Points lie about `spacing` apart [m].
/// Throws InputError where the model has no such line.
SpeakerOutline outline_of_model(const ModelDescription& model,
                                const std::function<Vec2(const Vec2&)>& map, double spacing);

}  // namespace genio
