#include "forward/base/text_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "forward/base/types.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, int error) {
  throw InputError(path + ": cannot be written: " + std::strerror(error));
}

/// Errors name `path`, whatever the file is called for now.
void write_bytes(const std::string& file, const std::string& text, const std::string& path) {
  const int out = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (out < 0) refuse(path, errno);
  for (size_t done = 0; done < text.size();) {
    const ssize_t n = write(out, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      close(out);
      refuse(path, error);
    }
    done += size_t(n);
  }
  if (close(out) != 0) refuse(path, errno);
}

}  // namespace

void replace_file(const std::string& path, const std::function<void(const std::string&)>& write) {
  std::error_code none;
  if (fs::exists(path, none) && !fs::is_regular_file(path, none)) return write(path);
  const std::string beside = path + ".new";
  std::error_code error;
  try {
    write(beside);
    fs::rename(beside, path, error);
  } catch (...) {
    fs::remove(beside, none);
    throw;
  }
  if (!error) return;
  fs::remove(beside, none);
  throw InputError(path + ": cannot be written: " + error.message());
}

void write_text(const std::string& path, const std::string& text) {
  replace_file(path, [&](const std::string& file) { write_bytes(file, text, path); });
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw InputError(path + ": cannot be made: " + error.message());
  if (!fs::is_directory(path, error)) throw InputError(path + ": is no folder");
}

}  // namespace genio
