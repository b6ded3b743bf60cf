#pragma once
// Which frames of a recording are asked for: by number, by time, by what was said.

#include <functional>
#include <string>
#include <vector>

#include "inverse/recording/base/contours.hpp"

namespace genio {

/// As the command line gives it; what is empty asks for all.
struct FrameChoice {
  std::string frames = {};  ///< "7", "3-9", "1.2s-1.8s" or "1.2s"
  std::string textgrid = {}, tier = {};
  std::vector<std::string> labels = {};
  std::string speaker = {}, recording = {};  ///< of those that the file has
};

/// Those of one speaker: of the one that is asked for, else of the only one. Throws InputError
/// where there are several and nobody says which, for one registration does not place two heads.
std::vector<ContourFrame> of_one_speaker(std::vector<ContourFrame> frames,
                                         const FrameChoice& choice, const std::string& path);

/// Throws InputError that names `option`, which makes one problem of all frames, where they are of
/// several recordings.
void check_one_recording(const std::vector<ContourFrame>& frames, const std::string& option,
                         const std::string& path);

/// Throws InputError where times fall from frame to frame, as where two takes follow each other:
/// for options that make one movement of all frames.
void check_times_rise(const std::vector<ContourFrame>& frames, const std::string& option,
                      const std::string& path);

/// The frames that are asked for, of all that the file `path` has. Those that a TextGrid names have
/// its labels; a frame's time is NaN where the file gives no times. `remark` hears which labels
/// have no frame. No two have the same number: one recording is to be chosen where they would.
/// Throws InputError naming option, what the file has, and what was expected.
std::vector<ContourFrame> chosen_frames(std::vector<ContourFrame> frames, const FrameChoice& choice,
                                        const std::string& path,
                                        const std::function<void(const std::string&)>& remark);

}  // namespace genio
