#pragma once
// What every output says of how a recording was laid beside the model.

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "inverse/prior/terms/head_pose_prior.hpp"
#include "inverse/recording/session/session.hpp"
#include "runs/results/answer_view.hpp"

namespace genio {

struct RegistrationRecord {
  Judgement judgement;
  std::string units = {}, axes = {}, points_order = {};  ///< as they were read
  bool by_palate = true;                                 ///< false: by the contours alone
  bool given = false;                            ///< the file is in the model's frame by itself
  bool forced = false;                           ///< answered although it failed its test
  std::optional<double> bite_plane = {};         ///< its tilt against the model's [rad]
  std::map<HeadPoint, double> head_points = {};  ///< their distances from the model's [m]
};

/// Of a recording that was laid beside the model by its palate or without one.
RegistrationRecord record_of(const AlignedRecording& aligned, bool by_palate);

/// How well a registration knows the place of the head.
HeadPosePrior head_pose_of(const Registration& registration);

/// `scale, tilt_deg, shift_mm, palate_rms_mm, bite_plane_deg, hyoid_off_mm,
/// short_tendon_off_mm, mandible_off_mm, from_rest_mm, off_reach_mm, behind_palate, units, axes,
/// points_order, by, doubtful, reason, forced`; of a scan also `roll_deg, yaw_deg, lateral_mm`.
nlohmann::json registration_json(const RegistrationRecord& record);

/// The view with the registration, of which its title tells where it was forced.
AnswerView with_registration(AnswerView view, const RegistrationRecord& record);
/// The same of a registration that was kept as registration_json().
AnswerView with_registration(AnswerView view, const std::string& registration, bool forced);

/// The one object of a run that gave no forces: `status, message, registration`.
std::string no_forces_json(const std::string& message, const RegistrationRecord& record);

/// All faults in one sentence each; empty where there are none.
std::string faults_text(const Judgement& judgement);

}  // namespace genio
