#pragma once
// The places of a midsagittal outline that stand for the same in every speaker.

#include <string>
#include <vector>

#include "speaker/outline/outline.hpp"

namespace genio {

/// A stretch of the outline between two landmarks, in the order in which its points stand.
struct OutlineStretch {
  std::string name;  ///< "floor", as a file of modes names it
  int first, count;  ///< of its points among all
};

/// The stretches, one after another: floor (hyoid to the mandible), mandible (where the tongue lies
/// on it), mouth_floor (to the tip), surface (tip to vallecula), palate (from the
/// incisors 70 mm along the underside of palate and velum), hyoid (its middle) and pharynx.
const std::vector<OutlineStretch>& outline_stretches();
const OutlineStretch& outline_stretch(const std::string& name);
int outline_point_count();

/// Such points of one speaker. Those at equal parts of the length between two landmarks belong
/// together across speakers.
struct OutlinePoints {
  std::vector<Vec2> places;  ///< [m]
  std::vector<bool> known;   ///< false where the outline lacks the structure
};

/// Of an outline that faces the model. Throws InputError as tongue_landmarks() does.
OutlinePoints outline_points(const SpeakerOutline& outline);

/// The places of known points as a column x0 z0 x1 z1 ..., unknown ones as 0 [m].
Vector stacked_places(const OutlinePoints& points);

/// The outline that such points make: the tongue's whole line, palate and pharynx.
SpeakerOutline outline_through(const std::vector<Vec2>& places, const std::string& source);

}  // namespace genio
