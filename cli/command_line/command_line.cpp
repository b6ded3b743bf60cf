#include "cli/command_line/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/command_line/bash_completion.hpp"
#include "cli/command_line/command_table.hpp"
#include "cli/command_line/man_page.hpp"
#include "forward/base/nearest_name.hpp"
#include "forward/base/types.hpp"

namespace genio::cli {
namespace {

struct Declared {
  CLI::App* app;
  Options options;
  Runner run;
};

OptionTable table_of(const CLI::Option& option, const Rules& rules) {
  OptionTable table;
  table.name = option.get_name();
  table.positional = option.get_positional();
  table.help = option.get_description();
  table.flag = option.get_items_expected_max() == 0;
  if (!table.flag) table.value = option.get_type_name().substr(0, option.get_type_name().find(':'));
  if (rules.shows_default) table.otherwise = option.get_default_str();
  table.values = rules.among.empty() ? rules.suggested : rules.among;
  return table;
}

CommandTable table_of(const Declared& declared) {
  CommandTable table{declared.app->get_name(),
                     declared.app->get_description(),
                     declared.app->get_footer(),
                     {},
                     {}};
  for (const auto& [option, rules] : declared.options.declared())
    table.options.push_back(table_of(*option, rules));
  for (const CLI::App* sub : declared.app->get_subcommands([](const CLI::App*) { return true; }))
    table.commands.push_back(sub->get_name());
  return table;
}

std::vector<CommandTable> tables_of(const std::vector<Declared>& all) {
  std::vector<CommandTable> tables;
  for (const Declared& declared : all) tables.push_back(table_of(declared));
  return tables;
}

/// What follows no rule, in the words that the user knows; empty where nothing is left over.
std::string left_over(const CLI::App& app, const std::vector<Declared>& all) {
  if (const auto extra = app.remaining(); !extra.empty()) {
    const std::string& word = extra.front();
    std::vector<std::string> names;
    for (const Declared& d : all) names.push_back(d.app->get_name());
    if (word.starts_with("-")) return fmt::format("{}: stands before a subcommand", word);
    return fmt::format("{}: no such subcommand; did you mean {}? There are {}", word,
                       nearest_name(word, names), fmt::join(names, ", "));
  }
  for (const Declared& d : all) {
    std::vector<std::string> extra = d.app->remaining(true);
    if (extra.empty()) continue;
    const auto option = std::find_if(extra.begin(), extra.end(),
                                     [](const auto& word) { return word.starts_with("-"); });
    if (option == extra.end())
      return fmt::format("{}: '{}' is not expected; see genio {} --help", d.app->get_name(),
                         extra.front(), d.app->get_name());
    std::vector<std::string> names = {"--help"};
    for (const auto& [declared, rules] : d.options.declared())
      if (!declared->get_positional()) names.push_back(declared->get_name());
    const std::string name = option->substr(0, option->find('='));
    return fmt::format("{}: genio {} has no such option; did you mean {}?", name, d.app->get_name(),
                       nearest_name(name, names));
  }
  return {};
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// What is wrong with the words of a command line.
std::string complaint(const CLI::App& app, const std::vector<Declared>& all,
                      const CLI::ParseError& e) {
  if (const std::string what = left_over(app, all); !what.empty()) return what;
  std::string command = "genio";
  for (const Declared& d : all)
    if (d.app->parsed()) command += " " + d.app->get_name();
  return fmt::format("{}; see {} --help", one_line(e.what()), command);
}

int refuse(const CLI::App& app, const std::vector<Declared>& all, const CLI::ParseError& e) {
  fmt::print(stderr, "genio: {}\n", complaint(app, all, e));
  return bad_input;
}

void declare(CLI::App& app, const Subcommand& s, std::vector<Declared>& all) {
  CLI::App* sub = app.add_subcommand(s.name, s.about);
  Options options(*sub);
  const Runner run = s.declare(options);
  all.push_back({sub, options, run});
}

/// What is made of the tables of all subcommands.
void declare_tables(CLI::App& app, std::vector<Declared>& all) {
  declare(app,
          {"completion", "Completion of subcommands and options, for a shell",
           [](Options& options) -> Runner {
             static std::string shell;  // the only one there is
             options.add("shell", shell, "bash", {.required = true, .among = {"bash"}});
             options.footer(
                 "Example: genio completion bash > ~/.local/share/bash-completion/"
                 "completions/genio");
             return {};
           }},
          all);
  all.back().run = [&all]() -> int {
    fmt::print("{}", bash_completion(tables_of(all)));
    return done;
  };
  declare(app,
          {"man", "The manual page, as man reads it",
           [](Options& options) -> Runner {
             options.footer("Example: genio man > genio.1");
             return {};
           }},
          all);
  all.back().run = [&all]() -> int {
    fmt::print("{}", man_page(tables_of(all)));
    return done;
  };
}

}  // namespace

int run_command_line(int argc, char** argv, const std::vector<Subcommand>& subcommands) {
  CLI::App app{"Genio: muscle forces from measured tongue shapes."};
  app.footer(
      "Examples: genio invert --target contour.csv --out results\n"
      "          genio invert --target export.txt --palate palate.txt --out results\n"
      "          genio forward --force GGP=4 --out shape\n"
      "`genio SUBCOMMAND --help` shows the options of one; `genio formats` what can be read.");
  app.name("genio");
  app.require_subcommand(1);
  app.set_version_flag("--version", "genio " GENIO_VERSION);
  std::vector<Declared> all;
  for (const Subcommand& s : subcommands) declare(app, s, all);
  declare_tables(app, all);
  if (argc < 2) {
    fmt::print("{}", app.help());
    return done;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return e.get_exit_code() == 0 ? app.exit(e) : refuse(app, all, e);
  }
  for (const Declared& d : all)
    if (d.app->parsed()) {
      d.options.check();
      return d.run();
    }
  return bad_input;
}

void read_words(const std::string& subcommand, const std::vector<std::string>& words,
                const std::function<void(Options&)>& declare_options) {
  CLI::App app;
  CLI::App* sub = app.add_subcommand(subcommand);
  sub->set_help_flag();
  Options options(*sub);
  declare_options(options);
  std::vector<std::string> last_first(words.rbegin(), words.rend());
  last_first.push_back(subcommand);
  try {
    app.parse(std::move(last_first));
  } catch (const CLI::ParseError& e) {
    throw InputError(complaint(app, {{sub, options, {}}}, e));
  }
  options.check();
}

}  // namespace genio::cli
