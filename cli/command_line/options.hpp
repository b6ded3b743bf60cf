#pragma once
// The options of a subcommand. Only options.cpp and command_line.cpp know the library that reads
// them.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_line/command.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace genio::cli {

/// What is asked of an option's value beside its type, and of the options beside it.
struct Rules {
  bool required = false;
  bool shows_default = false;  ///< in the help
  std::optional<std::pair<int, int>> range = {};
  bool positive = false;
  std::vector<std::string> among = {};
  std::vector<std::string> suggested = {};  ///< to complete: values that are usual
  char separator = 0;                       ///< between the values of a list
  /// Options without any of which this one would do nothing, and such as it does not go with:
  /// an error that says so.
  std::vector<std::string> only_with = {}, not_with = {};
};

/// An option with its rules.
struct DeclaredOption {
  CLI::Option* option;
  Rules rules;
};
using DeclaredOptions = std::vector<DeclaredOption>;

/// Declares options by name. Their values must live until the command has run.
class Options {
 public:
  explicit Options(CLI::App& app) : app_(&app), declared_(std::make_shared<DeclaredOptions>()) {}

  /// "--name", or "name" for a value that stands by itself.
  void add(const char* name, std::string& value, const std::string& help, const Rules& rules = {});
  void add(const char* name, double& value, const std::string& help, const Rules& rules = {});
  void add(const char* name, std::optional<double>& value, const std::string& help,
           const Rules& rules = {});
  void add(const char* name, int& value, const std::string& help, const Rules& rules = {});
  void add(const char* name, unsigned& value, const std::string& help, const Rules& rules = {});
  void add(const char* name, std::vector<std::string>& value, const std::string& help,
           const Rules& rules = {});
  void flag(const char* name, bool& value, const std::string& help, const Rules& rules = {});
  /// Takes all that follows as it stands, --help too: see rest().
  void take_all();
  std::vector<std::string> rest() const;
  /// What the help ends with.
  void footer(const std::string& text);

  /// A command of its own that takes, of these options, those named.
  Options subcommand(const char* name, const char* about, const std::vector<std::string>& takes);
  /// True where the command line names this command.
  bool chosen() const;
  /// True where the command line gives the option "--name".
  bool given(const std::string& name) const;
  const DeclaredOptions& declared() const { return *declared_; }
  /// Throws InputError naming an option that the rules of those given refuse.
  void check() const;

 private:
  template <class T>
  void declare(const char* name, T& value, const std::string& help, const Rules& rules);

  struct Below {
    CLI::App* app;
    std::vector<std::string> takes;
  };
  CLI::App* app_;
  std::shared_ptr<DeclaredOptions> declared_;
  std::shared_ptr<std::vector<Below>> below_ = std::make_shared<std::vector<Below>>();
};

}  // namespace genio::cli
