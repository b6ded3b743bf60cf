#pragma once
// What binary files of arrays and structures hold, whatever library reads them.

#include <cstddef>
#include <string>
#include <vector>

namespace genio {

/// A value of such a file. Its children are a record's fields, by their names, or a list's
/// elements.
struct DataTree {
  enum class Kind { other, numbers, text, list, record };
  Kind kind = Kind::other;
  std::string name;              ///< of a field or a variable
  std::string text;              ///< UTF-8
  size_t rows = 0, columns = 0;  ///< of numbers and lists
  std::vector<double> numbers;   ///< column after column; may be left out where there are many
  std::vector<DataTree> children;

  /// The child of that name, in small or capital letters; null where there is none.
  const DataTree* find(const std::string& child) const;
  /// The number, where it is a single one; else NaN.
  double scalar() const;
};

/// The tree as bytes, to be sent to another process.
std::string packed(const DataTree& tree);

/// The tree of packed(). Throws InputError where the bytes are none.
DataTree unpacked(const std::string& bytes);

}  // namespace genio
