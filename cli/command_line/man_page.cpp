#include "cli/command_line/man_page.hpp"

#include <fmt/format.h>

namespace genio::cli {
namespace {

/// Text as troff prints it, line by line.
std::string plain(const std::string& text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') out += "\\e";
    else if (c == '-') out += "\\-";
    else out += c;
    line_start = c == '\n';
  }
  return out;
}

std::string item(const OptionTable& o) {
  std::string head = fmt::format("\\fB{}\\fR", plain(o.name));
  if (!o.flag && !o.positional) head += fmt::format(" \\fI{}\\fR", plain(o.value));
  std::string text = plain(o.help);
  if (!o.otherwise.empty()) text += fmt::format(" (default: {})", plain(o.otherwise));
  if (!o.values.empty())
    text += fmt::format("\n.br\nOne of {}", plain(fmt::format("{}", fmt::join(o.values, ", "))));
  return fmt::format(".TP\n{}\n{}\n", head, text);
}

std::string section(const CommandTable& command) {
  std::string page = fmt::format(".SS genio {}\n{}.\n", plain(command.name), plain(command.about));
  if (!command.commands.empty())
    page +=
        fmt::format("Below it: {}.\n", plain(fmt::format("{}", fmt::join(command.commands, ", "))));
  for (const OptionTable& o : command.options) page += item(o);
  if (!command.footer.empty()) page += fmt::format(".PP\n.nf\n{}\n.fi\n", plain(command.footer));
  return page;
}

}  // namespace

std::string man_page(const std::vector<CommandTable>& commands) {
  std::string page =
      ".TH GENIO 1 \"\" \"genio " GENIO_VERSION
      "\" \"User Commands\"\n"
      ".SH NAME\ngenio \\- muscle forces from measured tongue shapes\n"
      ".SH SYNOPSIS\n\\fBgenio\\fR \\fISUBCOMMAND\\fR [\\fIOPTION\\fR]...\n"
      ".SH DESCRIPTION\n"
      "Given a measured tongue shape, genio answers with the muscle forces that make it, how sure "
      "it is, and whether its model can make that shape at all.\n"
      ".SH SUBCOMMANDS\n";
  for (const CommandTable& command : commands) page += section(command);
  return page +
         ".SH EXIT STATUS\n.TP\n0\nDone.\n.TP\n1\nThe computation ended without an answer; the "
         "reason is printed.\n.TP\n2\nBad usage or bad input.\n";
}

}  // namespace genio::cli
