#pragma once
#include "forward/effects/modes/moved_rest.hpp"
#include "speaker/modes/outline_modes.hpp"

namespace genio {

/// The named modes as fields in a model's space. The points of the model's own outline move as
/// those of the speakers' mean do, turned as that lies in the model's frame and in proportion to
/// the sizes; between them the plane follows thin-plate splines. Of the width no outline tells: it
/// grows as lengths in the plane do on average. Throws InputError naming `source` where the model
/// has no such outline.
std::vector<NamedField> mode_fields(const OutlineModes& modes, const ModelDescription& model,
                                    const std::string& source);

}  // namespace genio
