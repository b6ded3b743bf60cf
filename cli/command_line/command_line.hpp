#pragma once
// The command line as a whole: which subcommand, and what is wrong with it.

#include <functional>
#include <string>
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

/// Reads words as the options of a subcommand that `declare` declares, with the values that it
/// names. Throws InputError with what the command line would say.
void read_words(const std::string& subcommand, const std::vector<std::string>& words,
                const std::function<void(Options&)>& declare);

}  // namespace genio::cli
