#pragma once
#include <limits>
#include <string>
#include <vector>

#include "inverse/shape/infer.hpp"

namespace genio {

/// What is shown and kept of an answer; filled from an Answer or from a reply over LCM.
struct AnswerView {
  std::string title, status, message, verdict;
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< of the frame; NaN: not known
  std::string label, recording, speaker;                     ///< of the frame, where known
  std::vector<Estimate> muscles;
  std::vector<Estimate> others;  ///< parameters and head pose
  std::vector<JointForce> joint;
  std::vector<std::vector<std::string>> unidentified;
  std::vector<TradeOff> trade_offs;  ///< of each unidentified group
  double weight = 1;
  std::vector<Alternative> alternatives;
  int mixed_optima = 1;  ///< that the estimates hold, this one among them
  std::optional<double> mirrored;
  int outliers = 0;
  double rms_mm = 0, max_mm = 0, chi2_per_dof = 0, wall_s = 0;
  int iterations = 0, factorizations = 0;
  std::string registration;  ///< registration_json() as text; empty: not told
  /// Midsagittal, (x, z) [m]; measured points as the head is estimated to have been.
  std::vector<Vec2> measured, predicted;
};

/// Where points were measured, once the head is where `others` say that it was, (x, z) [m]: those
/// near the midsagittal plane.
std::vector<Vec2> measured_points(const Target& target, const std::vector<Estimate>& others);

/// All but what is said of the frame itself.
AnswerView view_of(const Model& model, const Target& target, const Answer& answer);

}  // namespace genio
