#pragma once
#include <string>
#include <utility>

namespace genio::cli {

/// The generic model as installed or in the source tree.
std::string default_model();
/// How speakers' outlines vary, beside it.
std::string default_modes();

/// Splits "NAME=VALUE"; throws InputError naming `option`.
std::pair<std::string, double> parse_assignment(const std::string& option, const std::string& text);

/// Takes the place of standard streams that the process was started without: a file or socket that
/// got such a number would be written into by whoever means the stream. Writing stays an error.
void fill_missing_streams();

/// A line of progress on standard error.
void print_line(const std::string& line);

}  // namespace genio::cli
