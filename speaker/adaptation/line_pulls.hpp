#pragma once
#include "speaker/adaptation/line_match.hpp"
#include "speaker/elastic/fold_free.hpp"

namespace genio {

/// How a mesh's midsagittal line is drawn to an outline.
struct LinePullOptions {
  double weight = 1;     ///< of a metre of line at a metre squared [J/m^3]
  double along = 0.02;   ///< part of the weight that holds places along the line
  double corner = 4e-3;  ///< line that the pull of an end counts as [m]
  double notch = 10e-3;  ///< the same of a notch's bottom, where the line misses it
};

/// Pulls on the line's edges, about 1 mm apart: from the line to the outline and, so that no bay of
/// the outline is cut off, from the outline to the line. A place is drawn to the nearest of those
/// within 8 mm along from where it belongs; so are the ends of the line. `node`: what
/// each of the line's nodes is called in the mesh whose places are `x`.
std::vector<Pull> line_pulls(const ModelLine& line, const std::vector<int>& node,
                             const Positions& x, const Polyline& outline, const LineMatch& match,
                             const LinePullOptions& options);

/// Distances between a mesh's midsagittal line and an outline, both ways, 0.5 mm apart [m].
struct LineDistances {
  double rms = 0, most = 0;            ///< all of it
  double free_rms = 0, floor_rms = 0;  ///< from the floor of the mouth on, and up to there
};
LineDistances line_distances(const ModelLine& line, const std::vector<int>& node,
                             const Positions& x, const Polyline& outline,
                             const TongueLandmarks& marks);

}  // namespace genio
