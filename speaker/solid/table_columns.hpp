#pragma once
// Columns of a table by their names.

#include <string>
#include <vector>

#include "inverse/recording/base/table_text.hpp"

namespace genio {

/// Where the column of that name stands, in small or capital letters; past the end where there is
/// none.
size_t column_named(const std::vector<std::string>& header, const std::string& name);

/// The number of a field. Throws InputError naming row and column.
double number_of_column(const std::string& name, const std::string& field, TableNumbers& numbers,
                        const TablePlace& place);

}  // namespace genio
