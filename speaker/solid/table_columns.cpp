#include "speaker/solid/table_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace genio {

size_t column_named(const std::vector<std::string>& header, const std::string& name) {
  const auto is_it = [&](const std::string& f) { return lower_case(trimmed(f)) == name; };
  return size_t(std::find_if(header.begin(), header.end(), is_it) - header.begin());
}

double number_of_column(const std::string& name, const std::string& field, TableNumbers& numbers,
                        const TablePlace& place) {
  const std::string text = trimmed(field);
  double value = 0;
  if (!numbers.parse(text, value))
    place.fail(fmt::format("column {}: {}", name, numbers.complaint(text)));
  return value;
}

}  // namespace genio
