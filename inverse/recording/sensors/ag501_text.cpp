#include "inverse/recording/sensors/ag501_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/samples/sensor_channels.hpp"

namespace genio {
namespace {

constexpr size_t values = 7;  // x y z phi theta rms extra, a channel

/// Where a row has a sensor's values; rms is `none` where there is no such column.
struct Channel {
  size_t x, y, z, rms;
};
constexpr size_t none = size_t(-1);

struct Layout {
  std::vector<std::string> names;
  std::vector<Channel> channels;
  size_t columns = 0;
};

bool is_header(const std::vector<std::string>& fields) {
  return std::any_of(fields.begin(), fields.end(),
                     [](const std::string& f) { return f.ends_with("_X") || f.ends_with("_Z"); });
}

Layout by_header(const std::vector<std::string>& fields, const TableLines& lines) {
  std::map<std::string, Channel> found;
  Layout layout{{}, {}, fields.size()};
  for (size_t k = 0; k < fields.size(); ++k) {
    const auto bar = fields[k].rfind('_');
    if (bar == std::string::npos) continue;
    std::string stem = fields[k].substr(0, bar);
    const std::string what = fields[k].substr(bar + 1);
    if (stem.starts_with("Ch") && stem.size() > 2) stem = stem.substr(2);
    const auto [it, fresh] = found.try_emplace(stem, Channel{none, none, none, none});
    if (fresh) layout.names.push_back(stem);
    size_t* place = what == "X"     ? &it->second.x
                    : what == "Y"   ? &it->second.y
                    : what == "Z"   ? &it->second.z
                    : what == "RMS" ? &it->second.rms
                                    : nullptr;
    if (!place) continue;
    if (*place != none) lines.fail(fmt::format("column {} stands there twice", fields[k]));
    *place = k;
  }
  std::erase_if(layout.names, [&](const std::string& name) {
    const Channel& c = found.at(name);
    return c.x == none || c.y == none || c.z == none;
  });
  if (layout.names.empty()) lines.fail("expected columns Ch1_X, Ch1_Y, Ch1_Z, ...");
  for (const auto& name : layout.names) layout.channels.push_back(found.at(name));
  return layout;
}

Layout by_count(size_t fields, const TableLines& lines) {
  if (fields % values != 0 || fields == 0)
    lines.fail(fmt::format("{} fields; expected 7 a channel", fields));
  Layout layout{numbered_sensors(fields / values), {}, fields};
  for (size_t c = 0; c < fields; c += values) layout.channels.push_back({c, c + 1, c + 2, c + 5});
  return layout;
}

RawContours read(const std::string& path, const ReadOptions& o) {
  TableLines lines(path);
  Layout layout;
  SensorTable table;
  TableNumbers numbers('\t');
  bool titled = false;
  std::optional<bool> row_names;  // R writes a row's name before its values, and no title for it
  for (std::string line; lines.next(line);) {
    auto fields = sensor_fields(line);
    if (fields.empty()) continue;
    if (layout.names.empty()) {
      titled = is_header(fields);
      const bool commas = line.find(',') != std::string::npos;
      if (!titled && commas && line.find_first_of(".\t;") == std::string::npos)
        lines.fail("has commas and no decimal points: are they decimal commas between commas?");
      layout = titled ? by_header(fields, lines) : by_count(fields.size(), lines);
      table.names = layout.names;
      if (titled) continue;
    }
    if (!row_names) row_names = titled && fields.size() == layout.columns + 1;
    if (fields.size() != layout.columns + size_t(*row_names))
      lines.fail(*row_names ? fmt::format("{} fields; the first row has a name and {} values",
                                          fields.size(), layout.columns)
                            : other_count(fields.size(), titled ? "header" : "first row",
                                          layout.columns, line));
    if (*row_names) fields.erase(fields.begin());
    auto& row = table.samples.emplace_back();
    auto& rms = table.rms.emplace_back();
    for (const Channel& c : layout.channels) {
      const double x = numbers.value(fields[c.x], lines), y = numbers.value(fields[c.y], lines),
                   z = numbers.value(fields[c.z], lines);
      row.push_back(sensor_position(x, y, z));
      rms.push_back(c.rms == none ? 0 : numbers.value(fields[c.rms], lines));
    }
  }
  return sensor_frames(path, std::move(table), o);
}

bool known_by_line(const FileStart& start) {
  const auto fields = sensor_fields(start.line);
  const auto has = [&](const char* tail) {
    return std::any_of(fields.begin(), fields.end(),
                       [&](const std::string& f) { return f.ends_with(tail); });
  };
  if (has("_X") && has("_Z") && (has("_phi") || start.line.find("Ch1_X") != std::string::npos))
    return true;
  if (fields.empty() || fields.size() % values != 0) return false;
  if (!std::all_of(fields.begin(), fields.end(), is_value)) return false;
  if (start.sensors_named) return true;
  // The seventh value of a channel is not used: no contour has a 0 at every seventh place.
  if (fields.size() < 2 * values) return false;
  for (size_t k = values - 1; k < fields.size(); k += values) {
    double extra = 0;
    if (parse_number(fields[k], extra) && extra != 0) return false;
  }
  return true;
}

}  // namespace

ContourFormat ag501_text_format() {
  ReadOptions sensors;
  sensors.sensors = {{"1", "tip"}};
  return {.traits = {.name = "ag501-text", .content = Content::sensors},
          .about = "Carstens AG501 text export, 7 values a channel",
          .known_by_bytes = {},
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "sweep.txt",
                      .text = "Ch1_X\tCh1_Y\tCh1_Z\tCh1_phi\tCh1_theta\tCh1_RMS\tCh1_Extra\n"
                              "12.5\t1\t-3.25\t0\t0\t0\t0\n",
                      .options = sensors}};
}

}  // namespace genio
