#pragma once
#include "cli/command_line/options.hpp"

namespace genio::cli {

Runner add_serve(Options& options);

}  // namespace genio::cli
