#pragma once
// One function a subcommand: declares its options and returns what runs it.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace genio::cli {

/// Exit status of the program.
enum Exit : int { done = 0, no_answer = 1, bad_input = 2 };

using Runner = std::function<int()>;

Runner add_info(CLI::App& app);
Runner add_import(CLI::App& app);
Runner add_forward(CLI::App& app);
Runner add_invert(CLI::App& app);
Runner add_discover(CLI::App& app);
Runner add_serve(CLI::App& app);
Runner add_request(CLI::App& app);
Runner add_bench(CLI::App& app);

/// The generic model as installed or in the source tree.
std::string default_model();

/// Splits "NAME=VALUE"; throws InputError naming `option`.
std::pair<std::string, double> parse_assignment(const std::string& option, const std::string& text);

}  // namespace genio::cli
