#include <fmt/format.h>

#include <cstdio>

#include "cli/bench.hpp"
#include "cli/discover.hpp"
#include "cli/forward.hpp"
#include "cli/import.hpp"
#include "cli/info.hpp"
#include "cli/invert.hpp"
#include "cli/request.hpp"
#include "cli/serve.hpp"
#include "forward/base/types.hpp"

int main(int argc, char** argv) {
  using namespace genio::cli;
  try {
    return run_command_line(
        argc, argv,
        {{"info", "What a model holds", add_info},
         {"import", "Make a model folder from foreign files", add_import},
         {"forward", "Shape from muscle forces", add_forward},
         {"invert", "Muscle forces from measured shapes in a file", add_invert},
         {"discover", "What a model misses, from measured shapes under several conditions",
          add_discover},
         {"serve", "Answer shape requests over LCM", add_serve},
         {"request", "Ask a server", add_request},
         {"bench", "Figures of merit, measured here", add_bench}});
  } catch (const genio::InputError& e) {
    fmt::print(stderr, "genio: {}\n", e.what());
    return bad_input;
  } catch (const std::exception& e) {
    fmt::print(stderr, "genio: {}\n", e.what());
    return no_answer;
  }
}
