#include "cli/subcommands/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "inverse/recording/format_list.hpp"

namespace genio::cli {
namespace {

constexpr size_t shown_lines = 3, shown_width = 72;

/// How a file of a format is recognised, as its own functions have it.
std::string recognition(const ContourFormat& format) {
  const std::string ending = std::filesystem::path(format.example.name).extension().string();
  if (format.known_by_bytes) {
    FileStart start{};
    start.ending = ending;
    if (format.known_by_bytes(start)) return fmt::format("by its ending, {}", ending);
    return "by its first bytes";
  }
  return format.known_by_line ? "by its first line" : "by --format alone";
}

const char* content(const ContourFormat& format) {
  switch (format.traits.content) {
    case Content::sensors:
      return "sensors";
    case Content::surface:
      return "surface";
    default:
      return "curves";
  }
}

/// As the command line says it; empty where nothing has to be said.
std::string options_of(const ReadOptions& o) {
  std::string text;
  for (const auto& [sensor, place] : o.sensors)
    text += fmt::format("{}{}={}", text.empty() ? "--sensors " : ",", sensor, place);
  const size_t sensors = text.size();
  for (const auto& [meaning, column] : o.columns)
    text += fmt::format("{}{}={}", text.size() == sensors ? " --columns " : ",", meaning, column);
  if (!o.units.empty()) text += " --units " + o.units;
  if (o.mm_per_px > 0) text += fmt::format(" --mm-per-px {}", o.mm_per_px);
  if (!o.facing.empty()) text += " --facing " + o.facing;
  if (!o.up.empty()) text += " --y-grows " + o.up;
  if (!o.spline.empty()) text += " --spline " + o.spline;
  if (o.rate_hz > 0) text += fmt::format(" --rate-hz {}", o.rate_hz);
  return text.starts_with(" ") ? text.substr(1) : text;
}

nlohmann::json to_json(const ContourFormat& format) {
  return {{"name", format.traits.name},
          {"written_by", format.about},
          {"content", content(format)},
          {"noise_mm", 1e3 * format.traits.noise},
          {"recognised", recognition(format)},
          {"example",
           {{"file", format.example.name},
            {"text", format.example.text},
            {"options", options_of(format.example.options)}}}};
}

/// The first lines, cut to the width of a terminal; what cannot be shown is a dot.
std::string beginning(const std::string& text) {
  std::istringstream in(text);
  std::string shown;
  size_t lines = 0;
  for (std::string line; lines < shown_lines && std::getline(in, line); ++lines) {
    std::replace(line.begin(), line.end(), '\t', ' ');
    std::erase(line, '\r');
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 32 || c == 127; }, '.');
    const bool cut = line.size() > shown_width;
    shown += fmt::format("    {}{}\n", line.substr(0, shown_width), cut ? "..." : "");
  }
  return shown + (in.peek() == EOF ? "" : "    ...\n");
}

void print_format(const ContourFormat& format) {
  const std::string options = options_of(format.example.options);
  fmt::print("{}: {}\n  {}; known {}; noise {:g} mm where nobody says\n  such as {}{}{}:\n{}\n",
             format.traits.name, format.about, content(format), recognition(format),
             1e3 * format.traits.noise, format.example.name, options.empty() ? "" : " with ",
             options, beginning(format.example.text));
}

}  // namespace

Runner add_formats(Options& options) {
  auto json = std::make_shared<bool>(false);
  options.flag("--json", *json, "One JSON object on standard output");
  options.footer("Example: genio formats");
  return [json]() -> int {
    nlohmann::json list = nlohmann::json::array();
    for (const ContourFormat& format : contour_formats())
      if (*json) list.push_back(to_json(format));
      else print_format(format);
    if (*json)
      fmt::print("{}\n", nlohmann::json{{"formats", list}}.dump(
                             -1, ' ', false, nlohmann::json::error_handler_t::replace));
    return done;
  };
}

}  // namespace genio::cli
