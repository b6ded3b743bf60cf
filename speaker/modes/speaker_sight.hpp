#pragma once
#include "speaker/modes/anatomy_estimate.hpp"

namespace genio {

/// The files of a speaker of whom little is known.
struct SightFiles {
  std::string palate;    ///< a palate trace, see read_outline_palate()
  std::string contours;  ///< contours of the tongue at rest in the same frame
  double noise = 5e-4;   ///< of both [m]
};

/// The most likely speaker behind them. Throws InputError naming the file where a tongue lies above
/// the palate, or the lines fit far better with the face looking the other way.
AnatomyEstimate estimate_from_files(const OutlineModes& modes, const SightFiles& files);

/// The outline that an estimate makes, from the incisors to where the trace begins; from there on
/// its palate is the trace, since that was measured.
SpeakerOutline sighted_outline(const AnatomyEstimate& estimate, const SightFiles& files);

/// What the modes make of a whole outline that lies in a model's frame, its points as they are
/// known.
AnatomyEstimate estimate_of_outline(const OutlineModes& modes, const SpeakerOutline& outline);

}  // namespace genio
