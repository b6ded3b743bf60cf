#include "cli/command_line/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "forward/base/types.hpp"

namespace genio::cli {
namespace {

/// True where the command line gives one of the options that have this name.
bool is_given(const CLI::App& app, const std::string& name) {
  const CLI::Option* option = app.get_option_no_throw(name);
  return option && option->count() > 0;
}

/// CLI11's own check names the largest number there is.
std::string above_zero(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && !*end && value > 0 && std::isfinite(value)
             ? ""
             : fmt::format("{}: expected a number above 0", text);
}

}  // namespace

template <class T>
void Options::declare(const char* name, T& value, const std::string& help, const Rules& rules) {
  CLI::Option* option = app_->add_option(name, value, help);
  if (rules.required) option->required();
  if (rules.range) option->check(CLI::Range(rules.range->first, rules.range->second));
  if (rules.positive) option->check(above_zero);
  if (!rules.among.empty()) option->check(CLI::IsMember(rules.among));
  if (rules.separator) option->delimiter(rules.separator);
  if (rules.shows_default) option->capture_default_str();
  declared_->push_back({option, rules});
}

void Options::add(const char* name, std::string& value, const std::string& help,
                  const Rules& rules) {
  declare(name, value, help, rules);
}

void Options::add(const char* name, double& value, const std::string& help, const Rules& rules) {
  declare(name, value, help, rules);
}

void Options::add(const char* name, std::optional<double>& value, const std::string& help,
                  const Rules& rules) {
  declare(name, value, help, rules);
}

void Options::add(const char* name, int& value, const std::string& help, const Rules& rules) {
  declare(name, value, help, rules);
}

void Options::add(const char* name, unsigned& value, const std::string& help, const Rules& rules) {
  declare(name, value, help, rules);
}

void Options::add(const char* name, std::vector<std::string>& value, const std::string& help,
                  const Rules& rules) {
  declare(name, value, help, rules);
}

void Options::flag(const char* name, bool& value, const std::string& help, const Rules& rules) {
  declared_->push_back({app_->add_flag(name, value, help), rules});
}

void Options::take_all() {
  app_->prefix_command();
  app_->set_help_flag();
}

std::vector<std::string> Options::rest() const { return app_->remaining(); }

void Options::footer(const std::string& text) { app_->footer(text); }

Options Options::subcommand(const char* name, const char* about,
                            const std::vector<std::string>& takes) {
  CLI::App* sub = app_->add_subcommand(name, about);
  sub->fallthrough();
  below_->push_back({sub, takes});
  return Options(*sub);
}

bool Options::chosen() const { return app_->parsed(); }

bool Options::given(const std::string& name) const { return is_given(*app_, name); }

void Options::check() const {
  for (const auto& [option, rules] : *declared_) {
    if (option->count() == 0) continue;
    const std::string name = option->get_name();
    for (const Below& below : *below_)
      if (below.app->parsed() &&
          std::find(below.takes.begin(), below.takes.end(), name) == below.takes.end())
        throw InputError(fmt::format("{}: '{} {}' does not take it", name, app_->get_name(),
                                     below.app->get_name()));
    const auto given_here = [&](const std::string& other) { return given(other); };
    if (!rules.only_with.empty() &&
        std::none_of(rules.only_with.begin(), rules.only_with.end(), given_here))
      throw InputError(
          fmt::format("{}: does nothing without {}", name, fmt::join(rules.only_with, " or ")));
    const auto other = std::find_if(rules.not_with.begin(), rules.not_with.end(), given_here);
    if (other != rules.not_with.end())
      throw InputError(fmt::format("{}: not together with {}", name, *other));
  }
}

}  // namespace genio::cli
