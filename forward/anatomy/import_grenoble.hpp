#pragma once
#include <string>

#include "forward/model/model_file.hpp"

namespace genio {

/// Reads the Grenoble tongue (ANSYS .node/.elem/.mac and OBJ, metres) from the folder that holds
/// `tongue/` and `surfaces_icp_m/`, with living-tissue constants. The styloid anchors, which are
/// no mesh nodes, are put where ArtiSynth has them (Stavness et al. 2012).
/// Throws InputError naming file and line.
ModelDescription import_grenoble(const std::string& folder);

}  // namespace genio
