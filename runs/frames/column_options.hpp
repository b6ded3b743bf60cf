#pragma once
#include <map>
#include <string>
#include <vector>

namespace genio {

/// Of --columns, "x=tongue_x": which column of a table is what. Throws InputError naming what is
/// unknown, missing or said twice.
std::map<std::string, std::string> parsed_columns(const std::vector<std::string>& columns);

}  // namespace genio
