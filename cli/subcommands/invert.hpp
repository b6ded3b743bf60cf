#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_invert(Options& options);

}  // namespace genio::cli
