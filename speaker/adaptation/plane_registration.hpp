#pragma once
#include "speaker/adaptation/line_pulls.hpp"
#include "speaker/outline/thin_plate.hpp"

namespace genio {

/// Where a model's midsagittal plane goes so that its line lies on an outline.
struct PlaneRegistration {
  std::vector<PlacePair> nodes;  ///< every node of the plane's faces [m]
  std::vector<int> numbers;      ///< their numbers in the model
  ThinPlateMap coarse;           ///< smooth, and close to it; it folds no face
  double scale = 1;              ///< of lengths, by the affine part
  LineMatch match;               ///< of the line and the outline
  LineDistances distances;
};

/// First a thin-plate map by landmarks and arc length between them, then one whose pairs slide to
/// where it bends least, as close as it folds no face (Bookstein's sliding semilandmarks); then the
/// faces as elastic tissue whose line is drawn to the outline and may slide along it.
/// `outline` lies in the model's frame.
PlaneRegistration register_plane(const ModelDescription& model, const ModelLine& line,
                                 const SpeakerOutline& outline);

}  // namespace genio
