#pragma once
// The line of JSON that is kept of a frame's answer, and what is read back from it.

#include <map>
#include <optional>
#include <string>

#include "runs/results/answer_view.hpp"
#include "runs/results/laid.hpp"

namespace genio {

/// One JSON object with the keys of the command line's answer; `indent` -1: on one line.
std::string answer_json(const AnswerView& view, int frame, int indent = -1);

/// "frame00007", for its files.
std::string frame_name(int frame);

/// What a run needs of an answer that was given before. Numbers that the line lacks are NaN.
struct AnswerRecord {
  int frame = 0;
  double time_s = 0;
  std::string label, recording, speaker;
  std::string status, verdict;
  double rms_mm = 0, max_mm = 0, chi2_per_dof = 0, wall_s = 0;
  std::map<std::string, double> forces_N, sd_N, activation, acts, median_N, max_force_N, low_N,
      high_N;                               ///< by muscle; those of the 90 % interval
  std::map<std::string, double> estimated;  ///< other unknowns, each in its own unit
  Laid registration = laid_in(std::string());
  std::string line;  ///< as it was written

  bool converged() const { return status == "converged"; }
};

/// True where both are the same answer to the same frame, as when neighbours started elsewhere:
/// forces within a tenth of their standard deviations, or a five-hundredth of their maxima.
bool agree(const AnswerRecord& a, const AnswerRecord& b);

/// Answers by frame.
using AnswerRecords = std::map<int, AnswerRecord>;

/// Reads a line of answer_json(); nothing where it is no such object, or is cut off.
std::optional<AnswerRecord> read_record(const std::string& line);

}  // namespace genio
