#include "forward/base/input_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "forward/base/types.hpp"

namespace genio {
namespace {

std::string size_text(std::uintmax_t bytes) {
  return bytes >> 30 ? fmt::format("{} GB", bytes >> 30) : fmt::format("{} MB", bytes >> 20);
}

}  // namespace

void check_input(const std::string& path, std::uintmax_t largest) {
  namespace fs = std::filesystem;
  if (path.find('\0') != std::string::npos)
    throw InputError("a file name holds a NUL byte; expected the name of a file");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw InputError(path + ": no such file");
  if (status.type() == fs::file_type::none)
    throw InputError(path + ": cannot be read: " + error.message());
  if (status.type() == fs::file_type::directory)
    throw InputError(path + ": is a folder; expected a file");
  if (status.type() != fs::file_type::regular)
    throw InputError(path + ": is a pipe or a device; expected a file on a disk");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw InputError(path + ": cannot be read: " + error.message());
  if (size > largest)
    throw InputError(
        fmt::format("{}: is larger than {}; expected a smaller file", path, size_text(largest)));
}

std::string read_file(const std::string& path, std::uintmax_t largest) {
  check_input(path, largest);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": cannot be read");
  std::string bytes;
  // A file that grows meanwhile is cut at the limit.
  for (char block[1 << 16]; bytes.size() < largest && (in.read(block, sizeof block), in.gcount());)
    bytes.append(block, size_t(in.gcount()));
  return bytes;
}

}  // namespace genio
