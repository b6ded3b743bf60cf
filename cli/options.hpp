#pragma once
// The options of a subcommand. Only options.cpp knows the library that reads them.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.hpp"

namespace CLI {
class App;
}

namespace genio::cli {

/// What is asked of an option's value beside its type.
struct Rules {
  bool required = false;
  bool shows_default = false;  ///< in the help
  std::optional<std::pair<int, int>> range = {};
  bool positive = false;
  std::vector<std::string> among = {};
  char separator = 0;  ///< between the values of a list
};

/// Declares options by name. Their values must live until the command has run.
class Options {
 public:
  explicit Options(CLI::App& app) : app_(&app) {}

  /// "--name", or "name" for a value that stands by itself.
  void add(const char* name, std::string& value, const std::string& help, const Rules& rules = {});
  void add(const char* name, double& value, const std::string& help, const Rules& rules = {});
  void add(const char* name, std::optional<double>& value, const std::string& help,
           const Rules& rules = {});
  void add(const char* name, int& value, const std::string& help, const Rules& rules = {});
  void add(const char* name, unsigned& value, const std::string& help, const Rules& rules = {});
  void add(const char* name, std::vector<std::string>& value, const std::string& help,
           const Rules& rules = {});
  void flag(const char* name, bool& value, const std::string& help);
  /// Takes all that follows as it stands, --help too: see rest().
  void take_all();
  std::vector<std::string> rest() const;
  /// What the help ends with.
  void footer(const std::string& text);

  /// A command of its own that shares these options.
  Options subcommand(const char* name, const char* about);
  /// True where the command line names this command.
  bool chosen() const;

 private:
  CLI::App* app_;
};

struct Subcommand {
  const char *name, *about;
  Runner (*declare)(Options&);
};

/// Reads the command line and runs the subcommand that it names. Prints help, version and what is
/// wrong with an option. Exceptions of the subcommand pass through.
int run_command_line(int argc, char** argv, const std::vector<Subcommand>& subcommands);

}  // namespace genio::cli
