#include "inverse/recording/base/axes_reading.hpp"

#include <fmt/format.h>

namespace genio {

std::string AxesReading::text(Content content) const {
  if (content == Content::sensors)
    return fmt::format("{}{} runs back along the head, {}{} up", back_grows ? "" : "-", "xyz"[back],
                       up_grows ? "" : "-", "xyz"[up]);
  return fmt::format("face {}, y {}", back_grows ? "left" : "right", up_grows ? "up" : "down");
}

std::string AxesReading::options(Content content) const {
  if (content == Content::sensors)
    return fmt::format("--axes={}{}{}{}", back_grows ? '+' : '-', "xyz"[back], up_grows ? '+' : '-',
                       "xyz"[up]);
  return fmt::format("--facing {} --y-grows {}", back_grows ? "left" : "right",
                     up_grows ? "up" : "down");
}

AxesReading parse_axes(const std::string& text) {
  const std::string letters = "xyz";
  const bool whole =
      text.size() == 4 && (text[0] == '+' || text[0] == '-') && (text[2] == '+' || text[2] == '-');
  const size_t back = whole ? letters.find(text[1]) : letters.npos;
  const size_t up = whole ? letters.find(text[3]) : letters.npos;
  if (back == letters.npos || up == letters.npos || back == up)
    throw InputError(
        fmt::format("--axes {}: expected the axis that runs back along the head and the one that "
                    "runs up, each with its sign, as in -x+z",
                    text));
  return {int(back), int(up), text[0] == '+', text[2] == '+'};
}

ContourFile turned(ContourFile file, const AxesReading& reading) {
  const bool sensors = file.format.content == Content::sensors;
  const int across = 3 - reading.back - reading.up;
  for (ContourFrame& frame : file.frames)
    for (ContourPoint& p : frame.points) {
      const Vec3 q = p.position;
      p.position = {reading.back_grows ? q[reading.back] : -q[reading.back],
                    sensors ? not_given : q[across],
                    reading.up_grows ? q[reading.up] : -q[reading.up]};
    }
  return file;
}

}  // namespace genio
