#pragma once
// The one test that a registration has to pass before forces are answered.

#include <numbers>

#include "inverse/recording/registration/registration.hpp"
#include "inverse/recording/scan_pose/scan_registration.hpp"

namespace genio {

/// What is known of where a recording lies beside the model's anatomy. Lengths in metres.
struct Judgement {
  double scale = 1, tilt = 0;  ///< [-], [rad]
  Vec2 shift = Vec2::Zero();   ///< of the middle of what was registered
  double palate_rms = 0;       ///< of the palate trace; 0: there is none
  double from_rest = 0;        ///< root mean square distance from the line at rest: median frame
  double off_reach = 0;        ///< from lines that muscles make: median frame
  double behind_palate = 0;    ///< share of points that lie beyond bone
  /// Of a scan alone: its turns about the axes that run back and up [rad], and sidewards shift.
  std::optional<Vec3> sideways = {};
  std::vector<std::string> faults = {};  ///< why it is not to be trusted; empty: it passed
};

/// Scales that fit a model: its tongue's line over those of 41 speakers, 120 to 160 mm (Serrurier &
/// Neuschaefer-Rube 2023), and 15 % more for what a palate tells of them.
std::pair<double, double> plausible_scales(const Model& model);

/// Judges contours (and a palate trace, where there is one) that the registration moves. It fails
/// where the scale is no speaker's, the head is tilted by more than 45 degrees, the trace is more
/// than 3 mm from the model's palate, or the contours lie beyond bone or out of a tongue's reach.
Judgement judge(const Model& model, const Registration& registration,
                const std::vector<std::vector<Vec2>>& contours, bool has_palate);

/// What no head is tilted by [rad].
inline constexpr double most_tilt = 45 * std::numbers::pi / 180;

/// Judges the points of a scan that lie in the model's frame, and how they came there, which is
/// left out where the caller says so. A scanner may stand as it likes: its tilt is no fault here.
Judgement judge_scan(const Model& model, const std::vector<Vec3>& points,
                     const std::optional<ScanRegistration>& registration, bool has_palate);

}  // namespace genio
