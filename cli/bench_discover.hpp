#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace genio::cli {

/// Runs the hidden-effect benchmark, or `sample` random cases of it (0: all), in `threads`
/// processes. What is done stands in FOLDER/results.jsonl and is not done again; an interrupted run
/// goes on where it was. `only_data`: makes the data sets and runs nothing. `only`: of the cases
/// whose names contain it. Throws InputError where there is none.
nlohmann::json bench_discover(const std::string& model, const std::string& folder, int sample,
                              unsigned seed, int threads, bool only_data, const std::string& only);

}  // namespace genio::cli
