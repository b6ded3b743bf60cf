#include "cli/commands.hpp"
#include "cli/run_bench.hpp"

namespace genio::cli {

Runner add_bench(CLI::App& app) {
  // All that follows is for genio-bench, --help too.
  app.prefix_command();
  app.set_help_flag();
  return [&app]() -> int { run_bench(app.remaining()); };
}

}  // namespace genio::cli
