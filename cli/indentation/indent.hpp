#pragma once
#include "cli/command_line/options.hpp"

namespace genio::cli {

Runner add_indent(Options& options);

}  // namespace genio::cli
