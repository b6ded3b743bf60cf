#include "forward/polygons/text_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "forward/base/types.hpp"

namespace genio {

bool TextCursor::next_line() {
  if (at_ >= text_.size()) return line_ = {}, false;
  ++number_;
  const size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
  line_ = text_.substr(at_, end - at_);
  at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
  return true;
}

bool TextCursor::next_word(std::string_view& word) {
  constexpr const char* blanks = " \t\v\f";
  const size_t first = line_.find_first_not_of(blanks);
  if (first == std::string_view::npos) return line_ = {}, false;
  const size_t end = std::min(line_.find_first_of(blanks, first), line_.size());
  word = line_.substr(first, end - first);
  line_.remove_prefix(end);
  return true;
}

double TextCursor::number(std::string_view word, const char* what) const {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // What is too small for a double is 0 as far as a surface goes.
  const bool tiny = error == std::errc::result_out_of_range &&
                    digits.find_first_of("eE") != digits.npos &&
                    digits[digits.find_first_of("eE") + 1] == '-';
  if ((error != std::errc() && !tiny) || end != digits.data() + digits.size())
    fail(fmt::format("{}; expected {}", shown(word), what));
  return tiny ? 0 : double(float(value));
}

double TextCursor::next_number(const char* what) {
  std::string_view word;
  if (!next_word(word)) fail(fmt::format("the line ends; expected {}", what));
  return number(word, what);
}

void TextCursor::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", path_, std::max(1, number_), what));
}

std::string shown(std::string_view word) {
  constexpr size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > 126) c = '?';
  return fmt::format("'{}{}'", text, word.size() > longest ? "..." : "");
}

}  // namespace genio
