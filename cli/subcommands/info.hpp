#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_info(Options& options);

}  // namespace genio::cli
