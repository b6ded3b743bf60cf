#include "cli/options.hpp"

#include <CLI/CLI.hpp>

namespace genio::cli {
namespace {

template <class T>
void declare(CLI::App& app, const char* name, T& value, const std::string& help,
             const Rules& rules) {
  CLI::Option* option = app.add_option(name, value, help);
  if (rules.required) option->required();
  if (rules.range) option->check(CLI::Range(rules.range->first, rules.range->second));
  if (rules.positive) option->check(CLI::PositiveNumber);
  if (!rules.among.empty()) option->check(CLI::IsMember(rules.among));
  if (rules.separator) option->delimiter(rules.separator);
  if (rules.shows_default) option->capture_default_str();
}

}  // namespace

void Options::add(const char* name, std::string& value, const std::string& help,
                  const Rules& rules) {
  declare(*app_, name, value, help, rules);
}

void Options::add(const char* name, double& value, const std::string& help, const Rules& rules) {
  declare(*app_, name, value, help, rules);
}

void Options::add(const char* name, std::optional<double>& value, const std::string& help,
                  const Rules& rules) {
  declare(*app_, name, value, help, rules);
}

void Options::add(const char* name, int& value, const std::string& help, const Rules& rules) {
  declare(*app_, name, value, help, rules);
}

void Options::add(const char* name, unsigned& value, const std::string& help, const Rules& rules) {
  declare(*app_, name, value, help, rules);
}

void Options::add(const char* name, std::vector<std::string>& value, const std::string& help,
                  const Rules& rules) {
  declare(*app_, name, value, help, rules);
}

void Options::flag(const char* name, bool& value, const std::string& help) {
  app_->add_flag(name, value, help);
}

void Options::take_all() {
  app_->prefix_command();
  app_->set_help_flag();
}

std::vector<std::string> Options::rest() const { return app_->remaining(); }

void Options::footer(const std::string& text) { app_->footer(text); }

Options Options::subcommand(const char* name, const char* about) {
  CLI::App* sub = app_->add_subcommand(name, about);
  sub->fallthrough();
  return Options(*sub);
}

bool Options::chosen() const { return app_->parsed(); }

int run_command_line(int argc, char** argv, const std::vector<Subcommand>& subcommands) {
  CLI::App app{"Genio: muscle forces from measured tongue shapes."};
  app.footer("Example: genio invert --target contour.csv --out results");
  app.require_subcommand(1);
  app.set_version_flag("--version", "genio " GENIO_VERSION);
  std::vector<std::pair<CLI::App*, Runner>> runners;
  for (const Subcommand& s : subcommands) {
    CLI::App* sub = app.add_subcommand(s.name, s.about);
    Options options(*sub);
    runners.emplace_back(sub, s.declare(options));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? done : bad_input;
  }
  for (const auto& [sub, run] : runners)
    if (sub->parsed()) return run();
  return bad_input;
}

}  // namespace genio::cli
