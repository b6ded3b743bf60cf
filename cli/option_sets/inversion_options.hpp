#pragma once
#include "cli/command_line/options.hpp"
#include "runs/frames/inversion.hpp"

namespace genio::cli {

/// Declares all options that an answer depends on: those of add_measured_options(), and of how it
/// is sought. The model is the generic one unless the command line says another.
void add_inversion_options(Options& options, InversionOptions& o);

}  // namespace genio::cli
