#pragma once
// What further measurements would tell, as text.

#include <string>

#include "inverse/planning/prospects.hpp"
#include "runs/frames/frame.hpp"

namespace genio {

/// The measurements, the one that tells most first: what part of the intervals' widths each takes
/// away, and what is left of the widest ones.
std::string plan_table(const Prospects& prospects);

/// One JSON object of a frame: `frame, status, verdict, now{}, measurements[]`, see
/// docs/planning.md.
std::string plan_json(const Frame& frame, const Answer& answer, const Prospects& prospects);

}  // namespace genio
