#include "cli/command_line/bash_completion.hpp"

#include <fmt/format.h>

namespace genio::cli {
namespace {

/// What may stand where a new word begins.
std::string words_of(const CommandTable& command) {
  std::string words = "--help";
  for (const OptionTable& o : command.options)
    if (!o.positional) words += " " + o.name;
    else if (!o.values.empty()) words += fmt::format(" {}", fmt::join(o.values, " "));
  for (const std::string& name : command.commands) words += " " + name;
  return words;
}

/// One branch an option that takes a value: its values, or files.
std::string values_of(const CommandTable& command) {
  std::string branches;
  for (const OptionTable& o : command.options)
    if (!o.positional && !o.flag)
      branches += fmt::format(
          "    {}:{}) COMPREPLY=($({} -- \"$word\")); return ;;\n", command.name, o.name,
          o.values.empty() ? "compgen -f"
                           : fmt::format("compgen -W '{}'", fmt::join(o.values, " ")));
  return branches;
}

}  // namespace

std::string bash_completion(const std::vector<CommandTable>& commands) {
  std::string names, words, values;
  for (const CommandTable& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
    words += fmt::format("    {}) words='{}' ;;\n", command.name, words_of(command));
    values += values_of(command);
  }
  return fmt::format(
      "# bash completion of genio, made by `genio completion bash`.\n"
      "_genio() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  local command=${{COMP_WORDS[1]}} words=\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '{} --help --version' -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case $command:$before in\n"
      "{}"
      "  esac\n"
      "  case $command in\n"
      "{}"
      "  esac\n"
      "  if [ \"${{word#-}}\" = \"$word\" ]; then\n"
      "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\") $(compgen -f -- \"$word\"))\n"
      "  else\n"
      "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
      "  fi\n"
      "}}\n"
      "complete -o filenames -F _genio genio\n",
      names, values, words);
}

}  // namespace genio::cli
