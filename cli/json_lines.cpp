#include "cli/json_lines.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "forward/base/types.hpp"
#include "report/svg.hpp"

namespace genio::cli {

JsonLines::JsonLines(const std::string& path, const std::string& key) : path_(path) {
  std::string whole;
  if (std::ifstream in(path_); in)
    for (std::string line; std::getline(in, line);) {
      auto object = nlohmann::json::parse(line, nullptr, false);
      if (!object.is_object() || !object.contains(key)) continue;  // cut off in mid-line
      known_.push_back(std::move(object));
      whole += line + "\n";
    }
  // A line without its end would swallow the next one.
  write_text(path_ + ".new", whole);
  std::error_code error;
  std::filesystem::rename(path_ + ".new", path_, error);
  if (error) throw InputError(fmt::format("{}: {}", path_, error.message()));
  out_.open(path_, std::ios::app);
  if (!out_) throw InputError(path_ + ": cannot be written");
}

void JsonLines::add(const nlohmann::json& line) {
  out_ << line.dump() << '\n' << std::flush;
  if (!out_) throw InputError(path_ + ": cannot be written (disk full?)");
}

}  // namespace genio::cli
