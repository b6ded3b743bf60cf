#include "runs/results/content_hash.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>

#include "forward/base/input_file.hpp"
#include "forward/base/types.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

/// Fowler, Noll and Vo's: of changes, not of attacks.
void mix(uint64_t& hash, std::string_view bytes) {
  for (const char c : bytes) hash = (hash ^ uint8_t(c)) * 0x100000001b3;
}

/// A block at a time: recordings are large.
void mix_file(uint64_t& hash, const std::string& path) {
  check_input(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": cannot be read");
  for (char block[1 << 16]; in.read(block, sizeof block), in.gcount() > 0;)
    mix(hash, {block, size_t(in.gcount())});
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
  std::error_code none;
  const fs::path file =
      fs::is_directory(path, none) ? fs::path(path) / "model.toml" : fs::path(path);
  uint64_t hash = 0xcbf29ce484222325;
  mix_file(hash, file.string());
  if (file.extension() == ".toml")
    for (const fs::path& named : named_files(file, read_file(file.string(), largest_settings)))
      mix_file(hash, named.string());
  return fmt::format("{:016x}", hash);
}

}  // namespace genio
