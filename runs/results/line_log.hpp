#pragma once
#include <fstream>
#include <functional>
#include <string>

namespace genio {

/// A file of one result a line, each on disk as soon as it is known.
class LineLog {
 public:
  /// Hands each line that `path` holds already to `take_up`, and keeps it where that says so: an
  /// interrupted write leaves a last line that is none. Throws InputError where the file cannot be
  /// written.
  LineLog(const std::string& path, const std::function<bool(const std::string& line)>& take_up);

  void add(const std::string& line);

 private:
  std::string path_;
  std::ofstream out_;
};

}  // namespace genio
