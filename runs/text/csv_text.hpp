#pragma once
#include <map>
#include <string>

namespace genio {

/// In quotes where a comma, a quote or the end of a line stands in it.
std::string csv_field(const std::string& text);

/// Empty where it is not known.
std::string csv_number(double number, int digits);

/// That of a name; empty where it has none.
std::string csv_number(const std::map<std::string, double>& by_name, const std::string& name,
                       int digits);

}  // namespace genio
