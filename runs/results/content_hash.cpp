#include "runs/results/content_hash.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "forward/base/types.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string() + ": no such file");
  return std::string(std::istreambuf_iterator<char>(in), {});
}

/// Fowler, Noll and Vo's: of changes, not of attacks.
void mix(uint64_t& hash, const std::string& bytes) {
  for (const char c : bytes) hash = (hash ^ uint8_t(c)) * 0x100000001b3;
}

/// Files beside a TOML file that it names in quotes, in the order of their names.
std::set<fs::path> named_files(const fs::path& path, const std::string& text) {
  std::set<fs::path> files;
  for (size_t open = text.find('"'); open != std::string::npos; open = text.find('"', open)) {
    const size_t end = text.find_first_of("\"\n", open + 1);
    if (end == std::string::npos) break;
    const fs::path file = path.parent_path() / text.substr(open + 1, end - open - 1);
    std::error_code none;
    if (text[end] == '"' && fs::is_regular_file(file, none)) files.insert(file);
    open = end + 1;
  }
  return files;
}

}  // namespace

std::string content_hash(const std::string& path) {
  const fs::path file = fs::is_directory(path) ? fs::path(path) / "model.toml" : fs::path(path);
  const std::string text = content(file);
  uint64_t hash = 0xcbf29ce484222325;
  mix(hash, text);
  if (file.extension() == ".toml")
    for (const fs::path& named : named_files(file, text)) mix(hash, content(named));
  return fmt::format("{:016x}", hash);
}

}  // namespace genio
