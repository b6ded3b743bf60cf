#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_bench(Options& options);

}  // namespace genio::cli
