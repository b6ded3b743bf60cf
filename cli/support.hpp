#pragma once
#include <string>
#include <utility>

namespace genio::cli {

/// The generic model as installed or in the source tree.
std::string default_model();

/// Splits "NAME=VALUE"; throws InputError naming `option`.
std::pair<std::string, double> parse_assignment(const std::string& option, const std::string& text);

/// A line of progress on standard error.
void print_line(const std::string& line);

}  // namespace genio::cli
