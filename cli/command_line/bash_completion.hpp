#pragma once
#include <string>
#include <vector>

#include "cli/command_line/command_table.hpp"

namespace genio::cli {

/// A script that bash reads to complete subcommands, options, values to choose from, and files.
std::string bash_completion(const std::vector<CommandTable>& commands);

}  // namespace genio::cli
