#pragma once
// The files of one session of a device: what their axes are, and where the model lies in them.

#include <optional>

#include "inverse/recording/base/axes_reading.hpp"
#include "inverse/recording/judgement.hpp"
#include "inverse/recording/session/session_file.hpp"

namespace genio {

/// A point of the head in a session.
struct SessionPoint {
  SessionFile file;      ///< one frame, of one point, each time that it was seen
  bool by_name = false;  ///< the target has it under its name; else the caller gives it
};
using SessionPoints = std::map<HeadPoint, SessionPoint>;

/// The option that gives a point of the head: "--hyoid", "--short-tendon" or "--jaw-shadow".
const char* option_of(HeadPoint point);

/// Those that are `given` as "X,Y" in the numbers of the target's contours, and where `named` is
/// true others that the target has under their names. Throws InputError where a text is no such
/// point, or the target holds no curves.
SessionPoints head_points_of(const SessionFile& target,
                             const std::map<HeadPoint, std::string>& given, bool named,
                             const ReadOptions& options);

/// Files and points of a session beside target and palate.
struct SessionMarks {
  std::optional<SessionFile> bite_plane = {};
  SessionPoints points = {};
};

/// A recording with its registration, and the reading of the axes that it belongs to.
struct AlignedRecording {
  ContourFile file;  ///< x backwards and z up, its place still the device's
  Registration registration;
  AxesReading reading;
  Judgement judgement;
  /// The bite plane's tilt against the model's occlusal plane, where there is one [rad].
  std::optional<double> bite_plane = {};
  std::map<HeadPoint, double> head_points = {};  ///< from the model's, once registered [m]
  /// Without a palate a reading that the caller excludes fits better, though not by far.
  bool turned_fits_better = false;
};

/// Finds the axes once for all files of the session. Every reading that the caller allows is
/// registered, by the palate where there is one, else by the contours alone, and by bite plane and
/// points of the head where there are any; the cheapest is taken. A bite plane far from the model's
/// is a fault, and so is a point that the caller gives. One that the target has under its name is
/// left out with a remark, but where none agrees with the rest that is a fault too. Throws
/// InputError where the caller gives a point that the model lacks.
/// A reading that the format or the caller excludes and that fits far better is a fault of the
/// judgement. Throws InputError that names both where two allowed ones fit alike.
AlignedRecording align(const Model& model, SessionFile target,
                       const std::optional<SessionFile>& palate, const ReadOptions& options,
                       const SessionMarks& marks = {});

/// The same with the model's reach at hand.
AlignedRecording align(const Model& model, const TongueReach& reach, SessionFile target,
                       const std::optional<SessionFile>& palate, const ReadOptions& options,
                       const SessionMarks& marks = {});

/// A reading of contours that fits far better than that in which they stand, as text; empty where
/// there is none, or they lie near the tongue at rest. Of files in the model's frame.
std::string better_reading(const Model& model, const ContourFile& file, double from_rest);

/// The points of all frames on the midsagittal line, curves and marked points, (x, z) [m].
std::vector<std::vector<Vec2>> midsagittal_points(const ContourFile& file);

/// A palate's points: a trace is one frame; the sweep of a sensor is all of them, (x, z) [m].
std::vector<Vec2> trace_of(const ContourFile& palate);

}  // namespace genio
