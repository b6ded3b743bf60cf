#pragma once
// Lines, fields and numbers of text tables, with errors that say where.

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// A row of a file, for messages.
class TablePlace {
 public:
  explicit TablePlace(std::string path) : path_(std::move(path)) {}
  int number() const { return number_; }
  const std::string& path() const { return path_; }
  /// Throws InputError "path:row: what".
  [[noreturn]] void fail(const std::string& what) const;

 protected:
  int number_ = 0;

 private:
  std::string path_;
};

/// Reads a text file line by line, as UTF-8. Takes LF, CRLF and CR, byte-order marks, UTF-16 with
/// its mark, and lines of Latin-1.
class TableLines : public TablePlace {
 public:
  /// Throws InputError where there is no such file, or one that check_input() refuses.
  explicit TableLines(const std::string& path);
  /// False at the end. Throws InputError at a NUL byte, and at a line that is longer than any
  /// table's.
  bool next(std::string& line);
  /// The first line with more than blanks. Throws InputError where there is none.
  std::string first_filled();
  /// The next line with more than blanks.
  bool next_filled(std::string& line);

 private:
  enum class Encoding { bytes, utf16_little, utf16_big };
  /// The next byte or UTF-16 unit; negative at the end.
  int unit();
  int character();

  std::ifstream in_;
  Encoding encoding_ = Encoding::bytes;
  int pushed_ = -2;  ///< a character that was read too early; -2: none
};

/// A field in double quotes may hold the separator; the quotes stay.
std::vector<std::string> split_fields(const std::string& line, char separator);

/// Fields between runs of blanks, as R writes tables.
std::vector<std::string> split_at_blanks(const std::string& line);

/// Tab, semicolon or comma, the first of these that the line holds; a blank where it holds none.
char separator_of(const std::string& line);

/// By split_at_blanks() where the separator is a blank.
std::vector<std::string> fields_of(const std::string& line, char separator);

/// Fields between tabs, semicolons, runs of blanks or commas, the first of these that the line
/// holds, as devices, R and spreadsheets write tables of sensors: without blanks and quotes at
/// their ends, and without an empty field after the last.
std::vector<std::string> sensor_fields(const std::string& line);

/// The field without blanks and quotes at its ends.
std::string trimmed(const std::string& field);

/// The text in small letters; only ASCII letters have them.
std::string lower_case(std::string text);

/// The field in single quotes, cut where it is long.
std::string in_quotes(const std::string& field);

/// True of what stands for a value that is not there: nothing, *, NA, NaN and their like.
bool is_missing(const std::string& field);

/// Number in a field; NaN and infinity count as no number. False when it is none.
bool parse_number(const std::string& field, double& value);

/// True of numbers with a decimal point or comma, and of what stands for a missing one.
bool is_value(const std::string& field);

/// What is wrong with a row of so many fields, where `where` has `expected`: "5 fields; the header
/// has 4". `line` tells whether decimal commas may have done it.
std::string other_count(size_t fields, const std::string& where, size_t expected,
                        const std::string& line);

/// Numbers of one table. It has decimal points or decimal commas, and never both.
class TableNumbers {
 public:
  /// Where the separator is a comma, there are no decimal commas.
  explicit TableNumbers(char separator) : commas_allowed_(separator != ',') {}
  /// False where it is no number, or of the other kind than those before.
  bool parse(const std::string& field, double& value);
  /// The same, and NaN where the field stands for a missing value, infinity included. Throws
  /// InputError naming the row.
  double value(const std::string& field, const TablePlace& place);
  /// What is wrong with a field that parse() refused.
  std::string complaint(const std::string& field) const;
  bool has_commas() const { return commas_; }

 private:
  bool commas_allowed_, commas_ = false, points_ = false;
};

}  // namespace genio
