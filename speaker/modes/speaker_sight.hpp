#pragma once
#include "speaker/modes/anatomy_estimate.hpp"

namespace genio {

/// The files of a speaker of whom little is known.
struct SightFiles {
  std::string palate;    ///< a palate trace, see read_outline_palate()
  std::string contours;  ///< contours of the tongue at rest in the same frame
  double noise = 5e-4;   ///< of both [m]
};

/// What they hold, the palate first. Throws InputError naming the file.
SpeakerSight sight_of_files(const SightFiles& files);

/// The most likely speaker behind a palate and contours of the file `source`. Throws InputError
/// naming it where a tongue lies above the palate, or the lines fit far better with the face
/// looking the other way.
AnatomyEstimate estimate_as_it_faces(const OutlineModes& modes, const SpeakerSight& sight,
                                     const std::string& source);

/// The outline that an estimate makes, from the incisors to where the palate's trace begins; from
/// there on its palate is the trace, since that was measured. It stands upright in the modes'
/// frame.
SpeakerOutline sighted_outline(const AnatomyEstimate& estimate, const SpeakerSight& sight,
                               const std::string& source);

/// What the modes make of a whole outline that lies in a model's frame, its points as they are
/// known.
AnatomyEstimate estimate_of_outline(const OutlineModes& modes, const SpeakerOutline& outline);

}  // namespace genio
