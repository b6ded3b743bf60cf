#include "cli/subcommands/bench.hpp"

#include "cli/run_bench.hpp"

namespace genio::cli {

Runner add_bench(Options& options) {
  options.take_all();  // all that follows is for genio-bench, --help too
  return [options]() -> int { run_bench(options.rest()); };
}

}  // namespace genio::cli
