#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_merge(Options& options);

}  // namespace genio::cli
