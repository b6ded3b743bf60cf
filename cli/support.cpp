#include "cli/support.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "forward/base/types.hpp"

namespace genio::cli {

namespace {

/// A file of data/ as installed or in the source tree.
std::string data_file(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path self = fs::read_symlink("/proc/self/exe", none);
  // Beside an installed program, in a source tree above its build folder, or where one stands.
  const fs::path installed = self.parent_path() / "../share/genio" / name;
  if (fs::exists(installed)) return installed.lexically_normal().string();
  for (fs::path up = self.parent_path(); up.has_relative_path(); up = up.parent_path())
    if (fs::exists(up / "data" / name)) return (up / "data" / name).string();
  return "data/" + name;
}

}  // namespace

std::string default_model() {
  if (const char* given = std::getenv("GENIO_MODEL")) return given;
  return data_file("generic/model.toml");
}

std::string default_modes() { return data_file("anatomy/outline_modes.csv"); }

std::pair<std::string, double> parse_assignment(const std::string& option,
                                                const std::string& text) {
  const auto equals = text.find('=');
  char* end = nullptr;
  const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
  const double number = std::strtod(value.c_str(), &end);
  if (equals == 0 || value.empty() || *end || !std::isfinite(number))
    throw InputError(fmt::format("{} {}: expected NAME=NUMBER, for example GGP=4", option, text));
  return {text.substr(0, equals), number};
}

void fill_missing_streams() {
  // The lowest number that is free is given.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", O_RDONLY) < 0) return;
}

void print_line(const std::string& line) { fmt::print(stderr, "{}\n", line); }

}  // namespace genio::cli
