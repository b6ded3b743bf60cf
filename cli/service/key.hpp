#pragma once
#include "cli/command_line/options.hpp"

namespace genio::cli {

Runner add_key(Options& options);

}  // namespace genio::cli
