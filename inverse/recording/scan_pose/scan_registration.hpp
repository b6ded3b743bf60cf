#pragma once
// Bringing a scan in any frame into the model's, by the palate's surface or by its own shape.

#include <optional>
#include <vector>

#include "inverse/target/facets.hpp"

namespace genio {

struct Model;

/// q -> scale turn q + shift.
struct ScanPose {
  double scale = 1;
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();  ///< [m]
  Vec3 operator()(const Vec3& q) const { return scale * (turn * q) + shift; }
};

/// The tongue's surface at rest and the few strongest ways in which muscles move it.
struct SurfaceReach {
  std::vector<Facet> facets;
  Positions rest;                ///< [m]
  std::vector<Positions> modes;  ///< displacements of one standard deviation each [m]
  double scale_sd = 0.06;        ///< of the speaker's size, see ModelDescription
};

/// Takes a static solve a muscle.
SurfaceReach surface_reach_of(const Model& model);

/// Points of a tongue's surface, and of the palate in the same frame where there is one [m].
struct Scan {
  std::vector<Vec3> tongue, palate;
};

struct ScanRegistration {
  ScanPose pose;
  double cost = 0;        ///< squares in units of their standard deviations
  double palate_rms = 0;  ///< of the scan's palate from the model's [m]
  double off_reach = 0;   ///< root mean square of the scan from a surface that muscles make [m]
  double free_scale = 1, free_gain = 0;  ///< as of Registration
  /// How well it is known: of the middle in the midsagittal plane [m], and of the turn there [rad].
  double shift_sd = 0, tilt_sd = 0;
  Mat3 level = Mat3::Identity();  ///< the rough orientation that it was found from
};

/// The distinct optima near a rough orientation, cheapest first: where the scan's axes, turned by
/// `level`, are the model's within some 20 degrees. Throws InputError where the scan brings a
/// palate and the model has none.
std::vector<ScanRegistration> register_scan(const Model& model, const SurfaceReach& reach,
                                            const Scan& scan, const std::vector<Mat3>& levels);

/// True where two poses lay the scan, of that middle, to the same place within a turn [rad] and a
/// way [m].
bool near_place(const ScanPose& a, const ScanPose& b, const Vec3& middle, double turn, double way);

/// The origin where there are none.
Vec3 mean(const std::vector<Vec3>& points);

/// Root mean square distance of points from the surface in a shape [m].
double rms_from_surface(const std::vector<Facet>& facets, const Positions& shape,
                        const std::vector<Vec3>& points);

}  // namespace genio
