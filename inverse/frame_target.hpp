#pragma once
#include "inverse/contour_file.hpp"
#include "inverse/registration.hpp"
#include "inverse/target.hpp"

namespace genio {

/// The frame in the model's frame. Leaves out ends of the contour that run through jaw or palate:
/// where the tongue's edge fades, trackers follow something else. Only whole ends, never points
/// from the middle; says so in the frame's note.
ContourFrame registered(const Model& model, const ContourFrame& frame, const Similarity& transform);

/// Target of one frame, which is in the model's frame: points without a noise of their own get
/// `noise` [m], flesh points are looked up in the model ("tip", "blade", "dorsum", "root",
/// "node:919"). Points farther than 120 mm from the tongue's middle mean wrong units.
/// Throws InputError naming the point.
Target make_target(const Model& model, const ContourFrame& frame, double noise);

/// Registers a file in a device's own axes by the palate trace of the same session, read from
/// `palate_path`. Throws InputError naming that file when it has no palate point.
Registration register_file(const Model& model, const ContourFile& file,
                           const std::string& palate_path, const std::string& format = "auto");

/// The curve points of all frames, (x, z) [m], in the file's frame.
std::vector<std::vector<Vec2>> midsagittal_points(const ContourFile& file);

/// What one assumes of a format when nobody says [m]: 0.5 mm for CSV, 1.5 mm for ultrasound.
double default_noise(ContourFormat format);

}  // namespace genio
