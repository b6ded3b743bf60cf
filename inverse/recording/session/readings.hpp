#pragma once
// The readings that a session's axes may have, each with its registration. Not for other rooms.

#include "inverse/recording/session/session.hpp"

namespace genio {

/// A reading of the axes and where it lays the recording.
struct RegisteredReading {
  AxesReading reading;
  Registration registration = {};
  double cost = 0;  ///< of the registration and of marked points about their places
  std::optional<double> bite_plane = {};         ///< as of AlignedRecording
  std::map<HeadPoint, double> head_points = {};  ///< the same
};

/// What a session's files hold; those beside the target may be absent.
struct SessionTraces {
  const ContourFile *target, *palate;
  const SessionMarks* marks;
};

/// Those that the device can have: with `said` the ones that the format (its `axes`) and the caller
/// allow, else all others. Of what the caller says outright nothing is left out.
std::vector<AxesReading> readings_of(const SessionTraces& session, const FileAxes& axes,
                                     const ReadOptions& options, bool said);

/// Each registered, the cheapest first.
std::vector<RegisteredReading> registered_readings(const Model& model, const TongueReach& reach,
                                                   const SessionTraces& session,
                                                   const std::vector<AxesReading>& readings);

/// The one test of a registration, for this one.
Judgement judged(const Model& model, const SessionTraces& session,
                 const RegisteredReading& reading);

/// An articulograph that stands as most do.
bool level(const AxesReading& reading);

/// By how much the rest of the recording contradicts its bite plane [rad]; 0 where it does not. The
/// registration follows a bite plane, so that one without it has to tell.
double contradiction(const Model& model, const TongueReach& reach, SessionTraces session,
                     const RegisteredReading& best);

/// The cheapest sound reading that is allowed where the sensors are named in the other order along
/// the tongue; empty where there is none.
std::optional<RegisteredReading> in_reversed_order(const Model& model, const TongueReach& reach,
                                                   SessionTraces session, const FileAxes& axes,
                                                   const ReadOptions& options);

/// "'face left, y up' (scale 1.00, tilt 3 degrees, cost 4; --facing left ..)".
std::string described(const RegisteredReading& reading, Content content);

}  // namespace genio
