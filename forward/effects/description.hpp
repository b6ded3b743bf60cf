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
  double density = 1040;                       ///< [kg/m^3] (Buchaillard et al. 2009)
  std::map<std::string, EffectTable> effects;  ///< absent table = absent effect
};

}  // namespace genio
