#pragma once
#include "cli/command_line/options.hpp"

namespace genio::cli {

Runner add_invert(Options& options);

}  // namespace genio::cli
