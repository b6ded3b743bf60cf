#pragma once
#include "forward/model/model_file.hpp"

namespace genio {

/// The same tongue with every element split in eight, its fibres through the new nodes and new ones
/// between neighbours, so that a muscle stays a distributed force and is no bundle of wires. The
/// midsagittal line stays the smooth one through the old nodes: through the middles of chords it
/// would lie flat.
ModelDescription refined(const ModelDescription& description);

}  // namespace genio
