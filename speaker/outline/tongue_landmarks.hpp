#pragma once
#include "speaker/outline/outline.hpp"
#include "speaker/outline/polyline.hpp"

namespace genio {

/// The places on a tongue's line that all tongues have, as arc lengths from its first point [m].
struct TongueLandmarks {
  double hyoid = 0;   ///< where the floor begins
  double genial = 0;  ///< where the floor meets the mandible
  double floor = 0;   ///< where the mandible ends and the floor of the mouth begins
  double notch = 0;   ///< where the line below the tip turns back sharply; 0: nowhere
  double tip = 0;
  double vallecula = 0;  ///< the end
};

/// The foremost place of a line between two arc lengths: the extreme along a direction that points
/// forwards and a little up, so that it lies on the tip and not below it [m].
double foremost(const Polyline& line, double from, double to);

/// Where a line turns most sharply forwards again between two arc lengths, as behind the floor of
/// the mouth [m].
double deepest_notch(const Polyline& line, double from, double to);

/// By the shape of an outline that faces the model. hyoid, genial and floor are 0 where the outline
/// is a free surface alone. Throws InputError where it lacks one.
TongueLandmarks tongue_landmarks(const SpeakerOutline& outline);

}  // namespace genio
