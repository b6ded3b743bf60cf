#pragma once
#include <string>

#include "runs/results/answer_record.hpp"

namespace genio {

/// Counts of status and verdict, quantiles of fit and time over the answers of a run , as lines for
/// people.
std::string summary_text(const AnswerRecords& answers);

/// Writes summary.csv (a row a frame: its time and label, registration, best fits,
/// standard deviations, probabilities to act, medians and 90 % intervals, fit, verdict) and
/// summary.svg, summary.png (the median force of every muscle) into `folder`.
void write_summary(const AnswerRecords& answers, const std::string& folder);

}  // namespace genio
