#pragma once
#include <string>
#include <vector>

#include "cli/command_line/command_table.hpp"

namespace genio::cli {

/// genio(1), as man reads it.
std::string man_page(const std::vector<CommandTable>& commands);

}  // namespace genio::cli
