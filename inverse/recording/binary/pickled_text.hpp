#pragma once
#include <string>
#include <vector>

namespace genio {

/// A list of tuples of texts as Python pickles it with protocol 0, in which PyTables keeps the
/// titles of a table's columns. Texts alone are read: whatever calls a function is refused. Throws
/// InputError beginning with `where`.
std::vector<std::vector<std::string>> pickled_titles(const std::string& pickled,
                                                     const std::string& where);

}  // namespace genio
