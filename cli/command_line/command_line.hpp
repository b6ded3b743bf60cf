#pragma once
// The command line as a whole: which subcommand, and what is wrong with it.

#include <vector>

#include "cli/command_line/options.hpp"

namespace genio::cli {

struct Subcommand {
  const char *name, *about;
  Runner (*declare)(Options&);
};

/// Reads the command line and runs the subcommand that it names. Prints help, version and, in one
/// line, what is wrong with an option. Adds `completion` and `man`, which are made of the tables of
/// all others. Exceptions of the subcommand pass through.
int run_command_line(int argc, char** argv, const std::vector<Subcommand>& subcommands);

}  // namespace genio::cli
