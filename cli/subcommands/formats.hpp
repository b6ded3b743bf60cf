#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_formats(Options& options);

}  // namespace genio::cli
