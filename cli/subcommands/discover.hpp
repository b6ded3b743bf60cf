#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_discover(Options& options);

}  // namespace genio::cli
