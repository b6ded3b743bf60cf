#pragma once
// The most likely speaker behind what was measured of him.

#include <optional>

#include "speaker/modes/outline_modes.hpp"

namespace genio {

/// A line that was measured somewhere along a stretch of the outline: a palate trace, or a contour
/// of the tongue at rest. Which of its points belongs where is not known.
struct SightedLine {
  std::vector<Vec2> points;  ///< in turn [m]
  bool palate = false;       ///< else the tongue from the floor of the mouth to the vallecula
  double noise = 5e-4;       ///< standard deviation across the line [m]
  bool at_points = false;    ///< only its points were measured, not the way between them
};

/// What was measured of a speaker, all in one frame with x backwards and z up.
struct SpeakerSight {
  std::vector<SightedLine> lines;
  std::optional<OutlinePoints> points;  ///< those that are known belong where they stand
  double point_noise = 5e-4;            ///< [m]
};

/// A speaker as the modes have him.
struct AnatomyEstimate {
  Vector values;             ///< of all modes [standard deviations among speakers]
  Matrix covariance;         ///< theirs; those of named modes stand first
  Similarity pose;           ///< from the modes' frame to that of the measurement; its scale is 1
  std::vector<Vec2> places;  ///< of all points in the measurement's frame [m]
  Vector sd;                 ///< of their coordinates [m]
  double rms = 0;            ///< of the measured lines from the estimate's [m]
  double cost = 0;           ///< minus the log posterior, to compare readings of the same lines
};

/// The mode of the posterior and its Gaussian approximation. The modes are independent normal
/// before the data; where the head was is hardly known (5 cm, 20 degrees), and found from several
/// turns. Lines count every 10 mm by their distance across the outline. Throws InputError where
/// they are too short to tell where the head was: less than 2 cm in all, or less than a palate and
/// a tongue where no point is known.
AnatomyEstimate estimate_anatomy(const OutlineModes& modes, const SpeakerSight& sight);

}  // namespace genio
