#include "forward/polygons/obj.hpp"

#include <fmt/format.h>

#include <charconv>

#include "forward/polygons/text_cursor.hpp"

namespace genio {
namespace {

/// The next word of a line, which goes on behind a backslash at its end.
bool obj_word(TextCursor& text, std::string_view& word) {
  for (;;) {
    if (!text.next_word(word)) return false;
    if (word.back() != '\\' || text.rest().find_first_not_of(" \t") != std::string_view::npos)
      return true;
    word.remove_suffix(1);
    if (!text.next_line()) return !word.empty();
    if (!word.empty()) return true;
  }
}

/// x y z; with a fourth number, x y z over it; what stands behind, such as colours, is passed over.
Vec3 obj_point(TextCursor& text) {
  std::vector<double> numbers;
  for (std::string_view word; numbers.size() < 8 && obj_word(text, word);)
    numbers.push_back(text.number(word, "a coordinate"));
  if (numbers.size() < 3)
    text.fail(fmt::format("{} coordinates; expected x, y and z", numbers.size()));
  Vec3 x(numbers[0], numbers[1], numbers[2]);
  if (numbers.size() == 4) x /= numbers[3];
  return x;
}

/// "7", "7/1", "7//3" or "-1", which is the point before; from 0.
int obj_corner(const TextCursor& text, std::string_view word, size_t points) {
  const std::string_view digits = word.substr(0, word.find('/'));
  int n = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
  if (error != std::errc() || end != digits.data() + digits.size() || n == 0 ||
      (n < 0 && size_t(-int64_t(n)) > points))
    text.fail(fmt::format("{}; expected the number of a point, from 1", shown(word)));
  return n < 0 ? int(points) + n : n - 1;
}

}  // namespace

Polygons read_obj(const std::string& path, std::string_view bytes) {
  TextCursor text(path, bytes);
  Polygons result;
  int largest = -1;
  while (text.next_line()) {
    std::string_view word;
    if (!obj_word(text, word)) continue;
    if (word == "v") {
      result.points.push_back(obj_point(text));
    } else if (word == "f") {
      const size_t first = result.corners.size();
      while (obj_word(text, word)) {
        result.corners.push_back(obj_corner(text, word, result.points.size()));
        largest = std::max(largest, result.corners.back());
      }
      if (result.corners.size() < first + 3) result.corners.resize(first);
      else result.close_face();
    }
  }
  if (largest >= int(result.points.size()))
    throw InputError(fmt::format("{}: a face names point {}; the file has {}", path, largest + 1,
                                 result.points.size()));
  return result;
}

}  // namespace genio
