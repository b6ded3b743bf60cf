#pragma once
// Lines and fields of text tables, with errors that say where.

#include <fstream>
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// Reads a file line by line; takes LF and CRLF and a byte-order mark.
class TableLines {
 public:
  explicit TableLines(const std::string& path);
  bool next(std::string& line);
  int number() const { return number_; }
  /// Throws InputError "path:line: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string path_;
  std::ifstream in_;
  int number_ = 0;
};

std::vector<std::string> split_fields(const std::string& line, char separator);

/// The field without blanks at its ends.
std::string trimmed(const std::string& field);

/// Number in a field; NaN and infinity count as no number. False when it is none.
bool parse_number(const std::string& field, double& value);

}  // namespace genio
