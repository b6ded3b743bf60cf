#pragma once
#include "cli/command_line/options.hpp"
#include "runs/frames/inversion.hpp"

namespace genio::cli {

/// Declares what says of one shape at a time: the model, add_measured_options(), and how it is
/// sought. The model is the generic one unless the command line says another.
void add_shape_options(Options& options, InversionOptions& o);

/// Declares all options that an answer depends on: those of add_shape_options(),
/// and of the frames together.
void add_inversion_options(Options& options, InversionOptions& o);

}  // namespace genio::cli
