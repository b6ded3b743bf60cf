#pragma once
#include <functional>

namespace genio::cli {

/// Exit status of the program.
enum Exit : int { done = 0, no_answer = 1, bad_input = 2 };

/// Runs a subcommand once its options are read; gives the exit status.
using Runner = std::function<int()>;

}  // namespace genio::cli
