#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_serve(Options& options);

}  // namespace genio::cli
