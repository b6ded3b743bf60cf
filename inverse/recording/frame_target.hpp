#pragma once
#include "inverse/recording/contour_file.hpp"
#include "inverse/recording/registration.hpp"
#include "inverse/target/target.hpp"

namespace genio {

/// The frame in the model's frame. Leaves out ends of the contour that run through jaw or palate:
/// where the tongue's edge fades, trackers follow something else. Only whole ends of curves, never
/// points from the middle; says so in the frame's note.
ContourFrame registered(const Model& model, const ContourFrame& frame, const Similarity& transform);

/// Target of one frame, which is in the model's frame: points without a noise of their own get
/// `noise` [m], flesh points are looked up in the model ("tip", "blade", "dorsum", "root",
/// "node:919"). Points farther than 120 mm from the tongue's middle mean wrong units.
/// Throws InputError naming the point.
Target make_target(const Model& model, const ContourFrame& frame, double noise);

/// A file laid into the model's frame.
struct RegisteredFile {
  ContourFile file;  ///< its points still in the device's frame
  Registration registration;
};

/// Registers a file in a device's own axes by the palate trace of the same session, read from
/// `palate_path`; a sweep of a sensor along the palate is read whole, options.sensors naming it.
/// Where nobody knows which way the face looks, the way that fits better. Throws InputError naming
/// that file when it has no palate point.
RegisteredFile register_file(const Model& model, ContourFile file, const std::string& palate_path,
                             const ReadOptions& palate_options = {});

/// The points of all frames on the midsagittal line, curves and marked points, (x, z) [m], in the
/// file's frame.
std::vector<std::vector<Vec2>> midsagittal_points(const ContourFile& file);

}  // namespace genio
