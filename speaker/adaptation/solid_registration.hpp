#pragma once
#include <optional>

#include "forward/geometry/triangle_surface.hpp"
#include "speaker/adaptation/plane_registration.hpp"

namespace genio {

/// The least ratio of corner Jacobians that an adapted element may have.
inline constexpr double least_corner_ratio = 0.1;

/// Tissue beside the midsagittal line that its distances stand for [m].
inline constexpr double solid_line_depth = 8e-3;

/// The mesh of an adapted model.
struct SolidRegistration {
  HexMesh mesh;
  LineDistances distances;  ///< of its midsagittal line and the outline
  double min_jacobian = 0;  ///< smallest ratio of corner Jacobians
  int repaired = 0;         ///< elements whose ratio was too small before they were repaired
};

/// Every node goes to where the plane's map takes it, with y times `lateral`; then the elements as
/// elastic tissue are drawn there, the midsagittal line to the outline, and corners that are too
/// small opened. A mesh that is its own mirror image stays so exactly. No element is folded; where
/// some stay below the least ratio, min_jacobian says so.
SolidRegistration register_solid(const ModelDescription& model, const ModelLine& line,
                                 const PlaneRegistration& plane, const SpeakerOutline& outline,
                                 double lateral);

/// Smallest ratio of corner Jacobians of a mesh.
double least_corner_jacobian_ratio(const HexMesh& mesh);

}  // namespace genio
