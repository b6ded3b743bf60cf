#pragma once
#include <string>

namespace genio {

/// In quotes where a comma, a quote or the end of a line stands in it.
std::string csv_field(const std::string& text);

/// Empty where it is not known.
std::string csv_number(double number, int digits);

}  // namespace genio
