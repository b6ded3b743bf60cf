#include "inverse/recording/sensors/xrmb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/samples/sensor_channels.hpp"

namespace genio {
namespace {

constexpr std::array pellets = {"UL", "LL", "T1", "T2", "T3", "T4", "MNI", "MNM"};
constexpr size_t columns = 1 + 2 * pellets.size();
constexpr double missing = 1e6;

FileAxes axes() { return {"um", "right", "up"}; }

RawContours read(const std::string& path, const ReadOptions& o) {
  TableLines lines(path);
  SensorTable table{{pellets.begin(), pellets.end()}, {}};
  table.axes = axes();
  TableNumbers numbers('\t');
  for (std::string line; lines.next(line);) {
    const auto fields = sensor_fields(line);
    if (fields.empty()) continue;
    if (fields.size() != columns)
      lines.fail(fmt::format("{} fields; expected {}: the time and 8 pellets' x and y",
                             fields.size(), columns));
    const double time = numbers.value(fields[0], lines);
    if (!std::isfinite(time)) lines.fail("no time in the first column");
    table.times_s.push_back(1e-6 * time);
    auto& row = table.samples.emplace_back();
    for (size_t k = 1; k < columns; k += 2) {
      const double x = numbers.value(fields[k], lines), y = numbers.value(fields[k + 1], lines);
      const bool seen = x != missing && y != missing;
      row.push_back(sensor_position(seen ? x : std::nan(""), 0, y));
    }
  }
  return sensor_frames(path, std::move(table), o);
}

bool known_by_line(const FileStart& start) {
  const auto fields = sensor_fields(start.line);
  if (fields.size() != columns || !std::all_of(fields.begin(), fields.end(), is_value))
    return false;
  // Micrometres, or pellets that are missing, are large numbers without decimals.
  double largest = 0, value = 0;
  for (const auto& field : fields)
    if (parse_number(field, value)) largest = std::max(largest, std::abs(value));
  return start.ending == ".txy" || largest > 5000;
}

RawContours read_palate(const std::string& path, const ReadOptions&) {
  TableLines lines(path);
  RawContours raw{{}, axes()};
  raw.file.model_frame = false;
  ContourFrame frame;
  frame.number = 1;
  TableNumbers numbers('\t');
  for (std::string line; lines.next(line);) {
    const auto fields = sensor_fields(line);
    if (fields.empty()) continue;
    if (fields.size() != 2)
      lines.fail(fmt::format("{} fields; expected x and y in micrometres", fields.size()));
    const double x = numbers.value(fields[0], lines), y = numbers.value(fields[1], lines);
    if (x == missing || y == missing || !std::isfinite(x + y)) continue;
    frame.points.push_back({Vec3(x, not_given, y), 0, "curve"});
  }
  if (frame.points.empty()) lines.fail("the file has no point");
  raw.file.frames.push_back(std::move(frame));
  return raw;
}

bool palate_known_by_line(const FileStart& start) {
  const auto fields = sensor_fields(start.line);
  double x = 0, y = 0;
  return start.ending == ".dat" && fields.size() == 2 && parse_number(fields[0], x) &&
         parse_number(fields[1], y) && std::max(std::abs(x), std::abs(y)) > 1000;
}

}  // namespace

ContourFormat xrmb_format() {
  ReadOptions sensors;
  sensors.sensors = {{"T1", "tip+10mm"}};
  return {.traits = {.name = "xrmb", .content = Content::sensors},
          .about = "X-ray microbeam .txy",
          .known_by_bytes = {},
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "tp009.txy",
                      .text = "0\t9000\t1000\t8000\t-9000\t-12500\t3250\t-30000\t9000\t-45000\t"
                              "9000\t1000000\t1000000\t-2000\t-9000\t-30000\t-9000\n",
                      .options = sensors}};
}

ContourFormat xrmb_palate_format() {
  return {.traits = {.name = "xrmb-palate"},
          .about = "X-ray microbeam jwNN_pal.dat",
          .known_by_bytes = {},
          .known_by_line = palate_known_by_line,
          .read = read_palate,
          .example = {.name = "jw11_pal.dat",
                      .text = "-5000\t2000\n-15000\t12000\n-30000\t18000\n-42000\t15000\n",
                      .options = {}}};
}

}  // namespace genio
