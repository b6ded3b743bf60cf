#pragma once
#include "forward/model/model_file.hpp"

namespace genio {

/// The speaker's right half (y >= 0) of a tongue that is its own mirror image, its midsagittal
/// nodes held in the plane: the same shapes for symmetric commands at less than half the cost.
/// Commands are those of the right side; an unpaired muscle keeps half its force. Throws InputError
/// naming `source` where an element crosses the plane or the halves differ.
ModelDescription half_of(const ModelDescription& whole, const std::string& source);

}  // namespace genio
