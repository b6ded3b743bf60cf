#pragma once
// What a model folder says, before any effect is built from it.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "forward/algebra/supports.hpp"
#include "forward/base/settings.hpp"
#include "forward/geometry/mesh.hpp"
#include "forward/geometry/triangle_surface.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

struct Landmarks {
  int tip = -1, dorsum = -1, root = -1;  ///< node numbers, 0-based
};

/// One mode of a speaker's anatomy: how far each point of the rest configuration moves for one
/// standard deviation among speakers [m].
struct AnatomyMode {
  std::string name;                      ///< "size", as a parameter of the effect `anatomy`
  std::vector<Vec3> nodes;               ///< of the mesh
  std::vector<Vec3> fixed_points;        ///< of the fibres: muscle by muscle, fibre by fibre
  std::vector<Vec3> palate, jaw, hyoid;  ///< of the surfaces' vertices
};

/// The displacement of the nodes by one standard deviation of a mode, as 3 n values [m].
inline Vector nodal_field(const AnatomyMode& mode) {
  return Eigen::Map<const Vector>(mode.nodes.data()->data(), 3 * Eigen::Index(mode.nodes.size()));
}

/// What a model folder says, before any effect is built from it.
struct ModelDescription {
  std::string name;
  std::string provenance;  ///< where it comes from, one line
  HexMesh mesh;
  std::vector<Support> supports;
  std::vector<Muscle> muscles;  ///< without segments
  Landmarks landmarks;
  std::vector<int> midsagittal;
  std::optional<TriangleSurface> palate, jaw, hyoid;
  std::vector<AnatomyMode> modes;  ///< what the effect `anatomy` moves
  /// How far the speaker's size may be from the model's, as a standard deviation of the logarithm:
  /// among speakers 6 %, and little once the model is the speaker's own.
  double scale_sd = 0.06;
  double density = 1040;                       ///< [kg/m^3] (Buchaillard et al. 2009)
  std::map<std::string, EffectTable> effects;  ///< absent table = absent effect
};

}  // namespace genio
