#pragma once
// One line a frame, on disk as soon as it is known.

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/json_lines.hpp"

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
  void add(const nlohmann::json& answer) { lines_->add(answer); }

 private:
  std::map<int, nlohmann::json> known_;
  std::optional<JsonLines> lines_;  // once it is known whether it may be taken up
};

}  // namespace genio::cli
