#include "runs/results/line_log.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "forward/base/input_file.hpp"
#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"

namespace genio {

LineLog::LineLog(const std::string& path,
                 const std::function<bool(const std::string& line)>& take_up)
    : path_(path) {
  std::string whole;
  if (std::error_code none; std::filesystem::exists(path_, none)) {
    check_input(path_, largest_whole);
    std::ifstream in(path_);
    if (!in) throw InputError(path_ + ": cannot be read");
    for (std::string line; std::getline(in, line);)
      if (take_up(line)) whole += line + "\n";
  }
  write_text(path_, whole);  // a line without its end would swallow the next one
  out_.open(path_, std::ios::app);
  if (!out_) throw InputError(path_ + ": cannot be written: " + std::strerror(errno));
}

void LineLog::add(const std::string& line) {
  errno = 0;
  out_ << line << '\n' << std::flush;
  if (!out_)
    throw InputError(
        path_ + ": cannot be written: " + (errno ? std::strerror(errno) : "the disk may be full"));
}

}  // namespace genio
