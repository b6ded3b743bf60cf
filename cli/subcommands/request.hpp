#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_request(Options& options);

}  // namespace genio::cli
