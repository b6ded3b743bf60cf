#pragma once
#include "speaker/adaptation/model_line.hpp"
#include "speaker/outline/thin_plate.hpp"

namespace genio {

/// How what surrounds a tongue goes with it: bones, and the fixed ends of fibres.
struct CarriedBones {
  ThinPlateMap map;       ///< of the midsagittal plane
  double palate_rms = 0;  ///< of the palate's front from the outline's; 0 where one lacks it [m]
};

/// The smooth map that takes the model's line in its rest shape to the line in the shape `x`, and
/// the midsagittal cuts of palate and jaw to the outline's own lines where these lie near. No bone
/// is drawn into the tongue's section, nor nearer than 0.3 mm.
CarriedBones carry_bones(const ModelDescription& model, const ModelLine& line, const Positions& x,
                         const SpeakerOutline& outline);

/// How deep the deepest free node of the tongue at rest lies within palate or jaw; 0 where none
/// does [m].
double rest_overlap(const ModelDescription& model);

}  // namespace genio
