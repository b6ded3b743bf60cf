#pragma once
#include <string>
#include <string_view>

namespace genio {

/// Walks a text in memory line by line, and each line word by word. Lines end in LF, CRLF or CR.
class TextCursor {
 public:
  /// `lines_before`: how many lines of the file stand before the text.
  TextCursor(std::string path, std::string_view text, int lines_before = 0)
      : path_(std::move(path)), text_(text), number_(lines_before) {}

  /// False at the end of the text.
  bool next_line();
  /// The next word between blanks of this line; false at its end.
  bool next_word(std::string_view& word);
  /// The rest of this line.
  std::string_view rest() const { return line_; }
  /// Where the text stands behind this line [bytes].
  size_t offset() const { return at_; }
  /// The word as a number of single precision. Throws InputError.
  double number(std::string_view word, const char* what) const;
  /// The next word of this line as a number. Throws InputError.
  double next_number(const char* what);
  /// Throws InputError "path:line: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string path_;
  std::string_view text_, line_;
  size_t at_ = 0;
  int number_ = 0;
};

/// A word for a message, cut where it is long, without control characters.
std::string shown(std::string_view word);

}  // namespace genio
