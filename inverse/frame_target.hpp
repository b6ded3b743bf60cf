#pragma once
#include <optional>

#include "inverse/contour_file.hpp"
#include "inverse/registration.hpp"
#include "inverse/target.hpp"

namespace genio {

/// Target of one frame: registered when `transform` is given, points without a noise of their own
/// get `noise` [m], flesh points are looked up in the model ("tip", "blade", "dorsum", "root",
/// "node:919"). Points farther than 80 mm from the tongue's middle mean wrong units.
/// Throws InputError naming the point.
Target make_target(const Model& model, const ContourFrame& frame,
                   const std::optional<Similarity>& transform, double noise);

/// The curve points of all frames, (x, z) [m], in the file's frame.
std::vector<std::vector<Vec2>> midsagittal_points(const ContourFile& file);

/// What one assumes of a format when nobody says [m]: 0.5 mm for CSV, 1.5 mm for ultrasound.
double default_noise(ContourFormat format);

}  // namespace genio
