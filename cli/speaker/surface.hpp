#pragma once
#include "cli/command_line/options.hpp"

namespace genio::cli {

Runner add_surface(Options& options);

}  // namespace genio::cli
