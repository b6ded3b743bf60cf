#pragma once
// What a recording tells of its speaker.

#include "inverse/recording/base/contours.hpp"
#include "speaker/modes/anatomy_estimate.hpp"

namespace genio {

/// The line that lies nearest to all others, by the mean distance of its points from them: a
/// posture that stands for all, as the mean articulation does in a speaker's outline. Of many lines
/// some are looked at. The lines have 2 points or more, and there is at least one.
size_t typical_line(const std::vector<std::vector<Vec2>>& lines);

/// The middle of all lines: each point of the `typical` one is moved across it to the median of
/// those that pass there. Points that fewer than half of them pass are left out.
std::vector<Vec2> middle_line(const std::vector<std::vector<Vec2>>& lines, size_t typical);

/// A palate's points from front to back, [m]. A trace is in turn already. Of a sweep, which runs
/// to and fro and leaves the palate at times, the upper points of every 3 mm are taken together.
std::vector<Vec2> ordered_trace(const std::vector<Vec2>& points);

/// A recording's palate and the middle of its frames, as the outlines that the modes are of are
/// means of many articulations.
struct RecordedSight {
  SpeakerSight sight;
  int frame = 0;  ///< number of the frame that lies nearest to all others
};

/// Frames and palate have one frame, x backwards and z up. `noise` [m]. Sensors count as the points
/// that they are. Throws InputError where no frame has two points of the tongue or more, or the
/// palate has none.
RecordedSight sight_of_recording(const std::vector<ContourFrame>& frames,
                                 const std::vector<Vec2>& palate, double noise);

}  // namespace genio
