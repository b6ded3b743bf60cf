#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace genio {

/// Counts of status and verdict, quantiles of fit and time over the answers of a run (to_json() of
/// each, by frame), as lines for people.
std::string summary_text(const std::map<int, nlohmann::json>& answers);

/// Writes summary.csv (a row a frame: forces, standard deviations, fit, verdict) and summary.svg,
/// summary.png (activation of every muscle over the frames) into `folder`.
void write_summary(const std::map<int, nlohmann::json>& answers, const std::string& folder);

}  // namespace genio
