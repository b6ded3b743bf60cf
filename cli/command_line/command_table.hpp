#pragma once
// What there is to know of the subcommands, for pages and completions.

#include <string>
#include <vector>

namespace genio::cli {

struct OptionTable {
  std::string name;         ///< "--target", or "shell" for a value that stands by itself
  bool positional = false;  ///< it stands by itself
  bool flag = false;        ///< it takes no value
  std::string value;        ///< what it takes: "TEXT"
  std::string otherwise;    ///< its default, where that is told
  std::string help;
  std::vector<std::string> values;  ///< to choose from, or usual ones
};

struct CommandTable {
  std::string name, about, footer;
  std::vector<OptionTable> options;
  std::vector<std::string> commands;  ///< below it
};

}  // namespace genio::cli
