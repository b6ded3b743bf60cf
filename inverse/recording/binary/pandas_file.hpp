#pragma once
#include <string>
#include <vector>

namespace genio {

/// A table as pandas writes it into HDF5.
struct PandasTable {
  std::vector<std::vector<std::string>> titles;  ///< of each column, level by level
  std::vector<std::string> index;                ///< of each row
  std::vector<std::vector<double>> rows;         ///< NaN: missing
};

/// The data frame in a file of pandas, in its format "fixed" or "table"; that called
/// df_with_missing, or the only one. Reads in a process of its own. Throws InputError naming
/// `path`.
PandasTable read_pandas_file(const std::string& path);

/// The same here and now. It is for tests of the reader on broken files: HDF5 may crash on them.
PandasTable pandas_file_table(const std::string& path);

}  // namespace genio
