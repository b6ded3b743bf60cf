#pragma once
// A scan and, where there is one, the palate in the same frame: laid beside the model in 3D.

#include "inverse/recording/session/session.hpp"

namespace genio {

/// A scan in the model's frame.
struct AlignedScan {
  ContourFile file;
  ScanRegistration registration;
  AxesReading reading;  ///< the nearest to how the scan's axes lie
  Judgement judgement;
};

/// Finds how a scan lies in the model's frame, by the palate's surface where there is one, else by
/// its own shape, whichever way its axes point. They are right-handed, else left and right would be
/// swapped. Throws InputError that names both readings where two of them fit alike.
AlignedScan align_scan(const Model& model, SessionFile target,
                       const std::optional<SessionFile>& palate, const ReadOptions& options);

/// All points of surfaces [m].
std::vector<Vec3> surface_points(const ContourFile& file);

}  // namespace genio
