#pragma once
#include "cli/command_line/command.hpp"

namespace genio::cli {

Runner add_surface(Options& options);

}  // namespace genio::cli
