#pragma once
// A model on disk: a folder with model.toml, mesh.vtu, fibres.vtp and surfaces.

#include <map>
#include <string>

#include "forward/model.hpp"
#include "forward/settings.hpp"

namespace genio {

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

/// Every effect name a model file may use. "muscles" is always there.
const std::vector<std::string>& effect_names();

/// Reads a model folder or the path of its model.toml. Throws InputError naming file and line.
ModelDescription read_description(const std::string& path);

/// Writes the folder; creates it where it does not exist.
void write_description(const ModelDescription& description, const std::string& folder);

/// Builds the effects. `source` is named in errors.
Model build_model(const ModelDescription& description, const std::string& source);

/// read_description and build_model.
Model read_model(const std::string& path);

}  // namespace genio
