#pragma once
// A figure or an experiment that is asked for by its name. Each stands in a .hpp/.cpp pair of its
// own that gives its Benchmark; bench/figures/table.cpp lists them all.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace genio::bench {

using Json = nlohmann::json;
/// Takes one line a step, for people who wait.
using Progress = std::function<void(const std::string&)>;

/// The values of all options. Each benchmark reads those that it takes.
struct BenchOptions {
  std::string model;                            ///< folder or model.toml
  std::string data, target, palate, out, only;  ///< empty where not given
  int sample = 0;                               ///< random cases; 0 where not given
  int threads = 1;
  unsigned seed = 1;
  bool all = false, only_data = false;
};

/// What an option means to one benchmark.
struct BenchOption {
  std::string name;   ///< "--data"
  std::string about;  ///< for the help
  bool needed = false;
};

struct Benchmark {
  std::string name;                       ///< as the command line has it
  std::string about;                      ///< one line for the help
  std::vector<BenchOption> options = {};  ///< beside --model and --json
  /// The figures as one JSON object. Throws InputError where an option or a file is wrong.
  Json (*run)(const BenchOptions&, const Progress&);
  /// The figures for people; null: the JSON itself, indented.
  std::string (*for_people)(const Json&) = nullptr;
};

}  // namespace genio::bench
