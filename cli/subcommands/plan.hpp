#pragma once
#include "cli/command_line/command.hpp"

namespace genio::cli {

Runner add_plan(Options& options);

}  // namespace genio::cli
