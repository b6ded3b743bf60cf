#pragma once
#include "cli/command_line/options.hpp"

namespace genio::cli {

Runner add_adapt(Options& options);

}  // namespace genio::cli
