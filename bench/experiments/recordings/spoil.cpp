#include "bench/experiments/recordings/spoil.hpp"

#include <algorithm>
#include <sstream>

namespace genio::bench {
namespace {

/// The target's axes are other than the palate's and than its format says. A device with unknown
/// facing whose every file is mirrored is a good one, so only the target is turned.
bool mirror(SyntheticSession& s, const Model&, std::mt19937&) {
  s.target_axes.back_grows = !s.target_axes.back_grows;
  // Who exports a mirrored image does so with all its files.
  if (s.device == Device::aaa) s.palate_axes.back_grows = !s.palate_axes.back_grows;
  return true;
}

bool turn_over(SyntheticSession& s, const Model&, std::mt19937&) {
  s.target_axes.up_grows = !s.target_axes.up_grows;
  if (s.device == Device::aaa) s.palate_axes.up_grows = !s.palate_axes.up_grows;
  return true;
}

bool other_unit(SyntheticSession& s, const Model&, std::mt19937& random) {
  const double by = std::vector<double>{0.1, 10, 2.54, 0.5}[random() % 4];
  s.target_unit *= by;
  if (random() % 2 == 0) s.palate_unit *= by;
  return true;
}

/// The palate of a sitting in which the probe or the head was elsewhere.
bool swap_palate(SyntheticSession& s, const Model&, std::mt19937& random) {
  if (s.device == Device::table) return false;
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double turn = 0.35 * (random() % 2 == 0 ? 1 : -1);
  s.palate_to_device.angle += turn;
  s.palate_to_device.shift +=
      0.03 * Vec2(uniform(random) < 0 ? -1 : 1, uniform(random) < 0 ? -1 : 1);
  return true;
}

/// A palate of another size and height.
bool other_speaker(SyntheticSession& s, const Model&, std::mt19937& random) {
  if (s.device == Device::table) return false;
  const double length = random() % 2 == 0 ? 0.7 : 1.4, height = random() % 2 == 0 ? 0.6 : 1.5;
  const Vec2 first = s.palate.front();
  for (Vec2& q : s.palate) q = first + Vec2(length * (q[0] - first[0]), height * (q[1] - first[1]));
  return true;
}

/// The points of two takes, one after the other, in one frame.
bool merge_takes(SyntheticSession& s, const Model&, std::mt19937&) {
  if (s.device == Device::articulograph) return false;  // a sample has each sensor once
  for (size_t f = 0; f + 1 < s.frames.size(); ++f)
    s.frames[f].insert(s.frames[f].end(), s.frames[f + 1].begin(), s.frames[f + 1].end());
  s.frames.resize(1);
  return true;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

bool is_number(const std::string& field) {
  return !field.empty() && field.find_first_not_of("-.0123456789") == std::string::npos;
}

/// One field more in every row of data, before the first number that is a coordinate.
bool shift_columns(WrittenSession& w, std::mt19937&) {
  auto lines = lines_of(w.target_text);
  const char separator = w.target.ends_with(".csv") ? ',' : '\t';
  for (std::string& line : lines) {
    const size_t dot = line.rfind('.');
    const size_t first = line.find(separator);
    if (dot == std::string::npos || first == std::string::npos || line.find("X0") != line.npos)
      continue;
    // Drop the last field and double the first separator: x and y change places.
    const size_t last = line.rfind(separator);
    line = line.substr(0, first) + separator + "0" + line.substr(first, last - first);
  }
  w.target_text = joined(lines);
  return true;
}

/// Decimal points lost from a tenth of the coordinates.
bool drop_decimals(WrittenSession& w, std::mt19937& random) {
  std::string text;
  size_t lost = 0, start = 0;
  const std::string& from = w.target_text;
  while (start < from.size()) {
    size_t end = from.find_first_of(",\t\n", start);
    if (end == std::string::npos) end = from.size() - 1;
    std::string field = from.substr(start, end - start);
    const size_t dot = field.find('.');
    if (is_number(field) && dot != std::string::npos && dot >= 2 && random() % 10 == 0)
      field.erase(dot, 1), ++lost;
    text += field + from[end];
    start = end + 1;
  }
  w.target_text = text;
  return lost > 0;
}

}  // namespace

const std::vector<Spoil>& spoils() {
  static const std::vector<Spoil> all = {{"mirrored", mirror},
                                         {"upside down", turn_over},
                                         {"wrong unit", other_unit},
                                         {"swapped palate", swap_palate},
                                         {"other speaker's palate", other_speaker},
                                         {"merged takes", merge_takes},
                                         {"shifted columns", nullptr, shift_columns},
                                         {"dropped decimal", nullptr, drop_decimals}};
  return all;
}

}  // namespace genio::bench
