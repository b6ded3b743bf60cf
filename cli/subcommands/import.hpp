#pragma once
#include "cli/options.hpp"

namespace genio::cli {

Runner add_import(Options& options);

}  // namespace genio::cli
