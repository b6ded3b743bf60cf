#pragma once
// A model's own midsagittal section and the line about it.

#include "forward/effects/description.hpp"
#include "speaker/outline/tongue_landmarks.hpp"

namespace genio {

/// The faces of a mesh in the midsagittal plane and the closed line about them, which begins at the
/// hyoid and runs as a whole outline does: along the floor to the mandible, up, over the tip and
/// dorsum to the vallecula, and then down at the hyoid. The model's supports tell where these are.
struct ModelLine {
  std::vector<Quad> faces;  ///< in the plane y = 0
  std::vector<int> nodes;   ///< of the line; the last is joined to the first
  /// Positions in `nodes`; the hyoid's is 0. `tip` is the model's own landmark.
  size_t genial = 0, floor = 0, tip = 0, vallecula = 0;

  /// Places of the nodes in the shape `x`, from the hyoid to the vallecula, in the plane [m].
  std::vector<Vec2> places(const Positions& x) const;
  /// Arc lengths of the landmarks along that line in the shape `x`. The tip is the foremost place,
  /// as of an outline.
  TongueLandmarks landmarks(const Positions& x) const;
};

/// Throws InputError naming `source` where the mesh has no faces in the plane y = 0, or the
/// supports no mandible or hyoid on the line about them.
ModelLine model_line(const ModelDescription& model, const std::string& source);

}  // namespace genio
