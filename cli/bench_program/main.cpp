// genio-bench: what `genio bench` runs. A program of its own, so that the one that most people
// build needs neither the benchmarks nor their problems.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/figures/table.hpp"
#include "cli/command_line/command.hpp"
#include "cli/support.hpp"
#include "forward/base/types.hpp"

namespace genio::cli {
namespace {

using bench::Benchmark;
using bench::BenchOption;
using bench::BenchOptions;

/// What an option means to the benchmarks that take it: "reach: targets (200); ...".
std::string meaning(const std::string& option) {
  std::vector<std::string> parts;
  for (const Benchmark& b : bench::benchmarks())
    for (const BenchOption& o : b.options)
      if (o.name == option)
        parts.push_back(fmt::format("{}{}: {}", b.name, o.needed ? " (needed)" : "", o.about));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Benchmark& b : bench::benchmarks()) all.push_back(b.name);
  return all;
}

std::string footer() {
  std::string text = "Benchmarks:\n";
  for (const Benchmark& b : bench::benchmarks())
    text += fmt::format("  {:<18} {}\n", b.name, b.about);
  return text + "\nExample: genio bench inverse";
}

void declare(CLI::App& app, std::string& what, BenchOptions& o, bool& json) {
  app.add_option("what", what, fmt::format("{}", fmt::join(names(), ", ")))
      ->required()
      ->check(CLI::IsMember(names()));
  app.add_option("--model", o.model, "Model folder or model.toml");
  app.add_option("--data", o.data, meaning("--data"));
  app.add_option("--target", o.target, meaning("--target"));
  app.add_option("--palate", o.palate, meaning("--palate"));
  app.add_option("--sample", o.sample, meaning("--sample"))->check(CLI::Range(1, 100000));
  app.add_option("--threads", o.threads, meaning("--threads"))->check(CLI::Range(1, 1024));
  app.add_flag("--only-data", o.only_data, meaning("--only-data"));
  app.add_option("--only", o.only, meaning("--only"));
  app.add_option("--seed", o.seed, meaning("--seed"));
  app.add_flag("--all", o.all, meaning("--all"));
  app.add_option("--out", o.out, meaning("--out"));
  app.add_flag("--json", json, "One JSON object on standard output");
  app.footer(footer());
}

void run(const Benchmark& b, const BenchOptions& o, bool json) {
  const auto result = bench::run_benchmark(b, o, print_line);
  if (json) fmt::print("{}\n", result.dump());
  else if (b.for_people) fmt::print("{}", b.for_people(result));
  else fmt::print("{}\n", result.dump(2));
}

}  // namespace
}  // namespace genio::cli

int main(int argc, char** argv) {
  using namespace genio::cli;
  CLI::App app{"Figures of merit, measured here.", "genio bench"};
  std::string what;
  BenchOptions options;
  options.model = default_model();
  bool json = false;
  declare(app, what, options, json);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? done : bad_input;
  }
  try {
    run(genio::bench::benchmark(what), options, json);
    return done;
  } catch (const genio::InputError& e) {
    fmt::print(stderr, "genio: {}\n", e.what());
    return bad_input;
  } catch (const std::exception& e) {
    fmt::print(stderr, "genio: {}\n", e.what());
    return no_answer;
  }
}
