#pragma once
// A recording that was read and laid beside the model once, for all tasks that take a part of it.

#include <string>

#include "runs/frames/measured.hpp"

namespace genio {

/// What tasks need of it beside its frames.
struct KeptRecording {
  double noise = 0;                        ///< [m]
  std::optional<HeadPosePrior> head_pose;  ///< how well the head's place is known
  std::string registration;                ///< registration_json() as text
  bool forced = false;                     ///< the registration failed its test
  std::vector<std::string> remarks;        ///< what was taken for granted
};

/// Writes recording.json and frames.jsonl, a frame a line, into `folder`.
void keep_recording(const Measured& measured, const std::vector<std::string>& remarks,
                    const std::string& folder);

/// Throws InputError where the file is missing or damaged.
KeptRecording kept_recording(const std::string& folder);

/// The frames from place `first` to before `end`. Throws InputError where they are not all there.
std::vector<ContourFrame> kept_frames(const std::string& folder, int first, int end);

}  // namespace genio
