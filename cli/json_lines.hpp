#pragma once
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace genio::cli {

/// A file of one JSON object a line, each on disk as soon as it is known. An interrupted write
/// leaves a last line that is none: it is dropped.
class JsonLines {
 public:
  /// Takes up the lines of `path` that are objects with the member `key`. Throws InputError where
  /// the file cannot be written.
  JsonLines(const std::string& path, const std::string& key);

  /// Those that were there.
  const std::vector<nlohmann::json>& known() const { return known_; }
  void add(const nlohmann::json& line);

 private:
  std::string path_;
  std::vector<nlohmann::json> known_;
  std::ofstream out_;
};

}  // namespace genio::cli
