#include <fmt/format.h>

#include <cstdio>
#include <vector>

#include "cli/commands.hpp"
#include "forward/base/types.hpp"

int main(int argc, char** argv) {
  using namespace genio::cli;
  CLI::App app{"Genio: muscle forces from measured tongue shapes."};
  app.footer("Example: genio invert --target contour.csv --out results");
  app.require_subcommand(1);
  app.set_version_flag("--version", "genio " GENIO_VERSION);
  std::vector<std::pair<CLI::App*, Runner>> commands;
  const auto add = [&](const char* name, const char* about, Runner (*declare)(CLI::App&)) {
    CLI::App* sub = app.add_subcommand(name, about);
    commands.emplace_back(sub, declare(*sub));
  };
  add("info", "What a model holds", add_info);
  add("import", "Make a model folder from foreign files", add_import);
  add("forward", "Shape from muscle forces", add_forward);
  add("invert", "Muscle forces from measured shapes in a file", add_invert);
  add("discover", "What a model misses, from measured shapes under several conditions",
      add_discover);
  add("serve", "Answer shape requests over LCM", add_serve);
  add("request", "Ask a server", add_request);
  add("bench", "Figures of merit, measured here", add_bench);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? done : bad_input;
  }
  try {
    for (auto& [sub, run] : commands)
      if (sub->parsed()) return run();
  } catch (const genio::InputError& e) {
    fmt::print(stderr, "genio: {}\n", e.what());
    return bad_input;
  } catch (const std::exception& e) {
    fmt::print(stderr, "genio: {}\n", e.what());
    return no_answer;
  }
  return bad_input;
}
