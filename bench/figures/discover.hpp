#pragma once
// The hidden-effect benchmark: its cases and one run of each.

#include "bench/experiments/hidden_data.hpp"
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Every data set of the benchmark: each effect at strengths 1 and 0.5 three times, nothing hidden
/// a hundred times (10 truths, 10 draws of noise), two effects ten times, effects of no library six
/// times; with forces known to 10 %, and unknown.
std::vector<HiddenCase> discover_cases();

/// Makes the data set of a case below `folder` unless it is there. Returns its answer, or why there
/// is none (`failed`).
Json prepare_discover_case(const ModelDescription& tongue, const HiddenCase& what,
                           const std::string& folder, KnownShapes& known);

/// Runs the discovery on a case, whose data are made where they are not there: its answer, and what
/// was found or the error.
Json run_discover_case(const ModelDescription& tongue, const HiddenCase& what,
                       const std::string& folder, KnownShapes& known);

}  // namespace genio::bench
