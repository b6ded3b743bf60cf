#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_forward(Options& options);

}  // namespace genio::cli
