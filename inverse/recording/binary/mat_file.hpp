#pragma once
#include "inverse/recording/binary/data_tree.hpp"

namespace genio {

/// The variables of a MATLAB file, v4 to v7.3, as fields of one record. Numbers are real and of two
/// dimensions at most; of what is none of these, and of columns longer than 100000 as sound is,
/// only the size is given. Reads in a process of its own. Throws InputError naming `path`.
DataTree read_mat_file(const std::string& path);

/// The same here and now. It is for tests of the reader on broken files: matio may crash on them.
DataTree mat_file_tree(const std::string& path);

}  // namespace genio
