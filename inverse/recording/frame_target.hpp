#pragma once
#include "inverse/recording/contour_file.hpp"
#include "inverse/recording/registration/registration.hpp"
#include "inverse/target/target.hpp"

namespace genio {

/// The frame in the model's frame. Leaves out ends of the contour that run through jaw or palate:
/// where the tongue's edge fades, trackers follow something else. Only whole ends of curves, never
/// points from the middle; says so in the frame's note.
ContourFrame registered(const Model& model, const ContourFrame& frame, const Similarity& transform);

/// Target of one frame, which is in the model's frame: points without a noise of their own get
/// `noise` [m], widened where the file is less sure of them, flesh points are looked up in the
/// model ("tip", "blade", "dorsum", "root", "node:919"). Points farther than 120 mm from the
/// tongue's middle mean wrong units. Throws InputError naming the point.
Target make_target(const Model& model, const ContourFrame& frame, double noise);

/// The nodes whose weighted positions are a marked point's ("tip", "node:919", ...). Throws
/// InputError for a place that there is not.
std::vector<std::pair<int, double>> place_weights(const Model& model, const std::string& place);

/// Where a marked point ("tip", "node:919", ...) lies at rest [m]. Throws InputError for a place
/// that there is not.
Vec3 place_at_rest(const Model& model, const std::string& place);

}  // namespace genio
