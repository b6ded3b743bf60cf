#pragma once
// Measured contours, read as the user describes them.

#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "forward/model/model.hpp"
#include "inverse/prior/terms/head_pose_prior.hpp"
#include "inverse/recording/contour_file.hpp"
#include "runs/frames/frame_choice.hpp"
#include "runs/frames/registration_record.hpp"

namespace genio {

/// As the command line gives them; errors name its options.
struct MeasuredOptions {
  std::string target, palate, palate_format, palate_units, palate_sensor, palate_spline, bite_plane;
  std::string hyoid, short_tendon, jaw_shadow;  ///< "X,Y" in the target's numbers
  std::vector<std::string> bite_plane_sensors;
  FrameChoice choice;
  std::vector<std::string> sensors;  ///< "5=tip"
  std::vector<std::string> columns;  ///< "frame=uniqueframe", of the target's table
  ReadOptions read;
  bool ignore_marks = false;  ///< leave out points of the head that the target names
  bool registered = false;    ///< already in the model's frame
  bool as_seen = false;       ///< leave the frames where the device has them, x back and z up
  bool force = false;         ///< answer also on a registration that fails its test
  double noise_mm = 0;
};

/// The points of the head that the options give, "X,Y" each; empty texts where they do not.
std::map<HeadPoint, std::string> given_head_points(const MeasuredOptions& o);

struct Measured {
  /// Those asked for, in the model's frame, or as they were seen where that is asked for; times are
  /// NaN where the file gives none.
  std::vector<ContourFrame> frames;
  double noise;  ///< [m]
  RegistrationRecord registration;
  /// What lays the frames of a device beside the model; none where they lie there by themselves,
  /// and of scans, which are turned in space.
  std::optional<Similarity> transform;
  /// How well the head's place is known where no palate tells it.
  std::optional<HeadPosePrior> head_pose;
};

/// What a device saw, its axes turned so that x runs backwards and z up, for others to register.
struct Unregistered {
  std::vector<ContourFrame> frames;  ///< those asked for
  std::vector<Vec2> palate;          ///< its trace, (x, z) [m]; empty where there is none
  double noise;                      ///< [m]
};

/// A recording that cannot be laid beside the model, with the reasons and what to try.
struct RegistrationFailed : std::runtime_error {
  explicit RegistrationFailed(const std::string& path, RegistrationRecord what);
  RegistrationRecord record;
};

/// Reads, picks the frames and registers by the palate trace where the file is in the device's own
/// axes, with the model that `model` gives only then. `remark` hears what was taken for granted and
/// how well that went. Throws RegistrationFailed where a registration fails its test and nobody
/// forces it, and InputError naming file, field or option.
Measured read_measured(const MeasuredOptions& o, const std::function<const Model&()>& model,
                       const std::function<void(const std::string&)>& remark);

/// Reads and picks the frames and registers nothing: format and caller say where the axes point.
/// `remark` as above. Throws InputError naming file, field or option.
Unregistered read_unregistered(const MeasuredOptions& o,
                               const std::function<void(const std::string&)>& remark);

}  // namespace genio
