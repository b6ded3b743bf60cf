#include "forward/base/text_file.hpp"

#include <filesystem>
#include <fstream>

#include "forward/base/types.hpp"

namespace genio {

void write_text(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  out << text;
  if (!out.flush()) throw InputError(path + ": cannot be written");
}

void replace_text(const std::string& path, const std::string& text) {
  write_text(path + ".new", text);
  std::error_code error;
  std::filesystem::rename(path + ".new", path, error);
  if (error) throw InputError(path + ": " + error.message());
}

}  // namespace genio
