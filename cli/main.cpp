#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "cli/command_line/command_line.hpp"
#include "cli/indentation/indent.hpp"
#include "cli/service/key.hpp"
#include "cli/service/request.hpp"
#include "cli/service/serve.hpp"
#include "cli/speaker/adapt.hpp"
#include "cli/speaker/surface.hpp"
#include "cli/subcommands/bench.hpp"
#include "cli/subcommands/corpus.hpp"
#include "cli/subcommands/discover.hpp"
#include "cli/subcommands/formats.hpp"
#include "cli/subcommands/forward.hpp"
#include "cli/subcommands/import.hpp"
#include "cli/subcommands/info.hpp"
#include "cli/subcommands/invert.hpp"
#include "cli/subcommands/journal.hpp"
#include "cli/subcommands/merge.hpp"
#include "cli/subcommands/plan.hpp"
#include "cli/support.hpp"
#include "forward/base/types.hpp"

namespace {

/// The status, unless what was printed could not be written: it may have waited in a buffer.
int told(int status) {
  errno = 0;
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
  fmt::print(stderr, "genio: standard output: cannot be written: {}\n",
             errno ? std::strerror(errno) : "the disk may be full");
  return genio::cli::bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace genio::cli;
  fill_missing_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error that is told
  try {
    return told(run_command_line(
        argc, argv,
        {{"info", "What a model holds", add_info},
         {"import", "Make a model folder from foreign files", add_import},
         {"forward", "Shape from muscle forces", add_forward},
         {"invert", "Muscle forces from measured shapes in a file", add_invert},
         {"plan", "What to measure next of a shape, to know its muscles better", add_plan},
         {"formats", "Files of measured shapes that are read", add_formats},
         {"merge", "Runs over several ranges of frames as one", add_merge},
         {"corpus", "Every recording of a table, here or on a cluster", add_corpus},
         {"discover", "What a model misses, from measured shapes under several conditions",
          add_discover},
         {"adapt", "A model that becomes a given speaker's", add_adapt},
         {"surface", "A bone's surface from slices, a label volume or a finer surface",
          add_surface},
         {"indent", "Tissue constants from an indentation experiment", add_indent},
         {"serve", "Answer shape requests over LCM", add_serve},
         {"request", "Ask a server", add_request},
         {"key", "Make a key that a server and its clients share", add_key},
         {"journal", "What a server accepted and answered, from its file", add_journal},
         {"bench", "Figures of merit, measured here", add_bench}}));
  } catch (const genio::InputError& e) {
    fmt::print(stderr, "genio: {}\n", e.what());
    return bad_input;
  } catch (const std::exception& e) {
    if (std::ferror(stdout)) return told(no_answer);
    fmt::print(stderr, "genio: {}\n", e.what());
    return no_answer;
  }
}
