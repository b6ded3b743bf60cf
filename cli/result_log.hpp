#pragma once
// One line a frame, on disk as soon as it is known.

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace genio::cli {

/// DIR/results.jsonl with the answers so far, and DIR/run.json with what was asked. A run that was
/// interrupted leaves both; `resume` takes its lines up and drops one that was cut off.
class ResultLog {
 public:
  /// `asked`: everything that an answer depends on. Throws InputError where the folder holds the
  /// answers to another question, or where answers would be overwritten without `resume`.
  ResultLog(const std::string& folder, const nlohmann::json& asked, bool resume);

  /// Frames answered by the run that is taken up.
  const std::map<int, nlohmann::json>& known() const { return known_; }
  void add(const nlohmann::json& answer);

 private:
  std::string path_;
  std::map<int, nlohmann::json> known_;
  std::ofstream out_;
};

}  // namespace genio::cli
