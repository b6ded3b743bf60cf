#pragma once
#include "speaker/outline/outline.hpp"

namespace genio {

/// The outline with x backwards and its tongue's line from the hyoid (or the floor of the mouth,
/// where it is a free surface alone) to the vallecula. Bones decide which way a face looks: the
/// pharynx, epiglottis and hyoid lie behind the mandible and the incisors. Without such a pair the
/// opening between the ends of a whole tongue's line lies behind. What is turned is told in a note.
/// Throws InputError where the facing is not certain, the outline stands on its head, or its parts
/// contradict each other.
SpeakerOutline facing_model(SpeakerOutline outline);

}  // namespace genio
