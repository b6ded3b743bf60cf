#include "inverse/recording/sensors/vtl_ema.hpp"

#include <fmt/format.h>

#include <cmath>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/samples/sensor_channels.hpp"

namespace genio {
namespace {

RawContours read(const std::string& path, const ReadOptions& o) {
  TableLines lines(path);
  std::vector<std::string> titles;
  std::string line;
  while (titles.empty() && lines.next(line))
    if (const auto fields = sensor_fields(line); !fields.empty() && fields[0].starts_with("time["))
      titles = fields;
  const SensorChannels sensors(titles);
  if (sensors.names().empty()) lines.fail("expected time[s] TB-x[cm] TB-y[cm] ...");
  SensorTable table{sensors.names(), {}};
  table.axes = {"cm", "right", "up"};
  TableNumbers numbers('\t');
  while (lines.next(line)) {
    const auto fields = sensor_fields(line);
    if (fields.empty() || fields[0].starts_with('#')) continue;
    if (fields.size() != titles.size())
      lines.fail(other_count(fields.size(), "header", titles.size(), line));
    std::vector<double> v;
    for (const auto& field : fields) v.push_back(numbers.value(field, lines));
    if (!std::isfinite(v[0])) lines.fail("no time in the first column");
    table.times_s.push_back(v[0]);
    table.samples.push_back(sensors.positions(v));
  }
  return sensor_frames(path, std::move(table), o);
}

}  // namespace

ContourFormat vtl_ema_format() {
  ReadOptions sensors;
  sensors.sensors = {{"TT", "tip"}};
  return {.traits = {.name = "vtl-ema", .content = Content::sensors},
          .about = "VocalTractLab .ema",
          .known_by_bytes = {},
          .known_by_line =
              [](const FileStart& start) {
                return start.line.starts_with("time[s]") ||
                       (start.ending == ".ema" && start.line.starts_with('#'));
              },
          .read = read,
          .example = {.name = "vowel.ema",
                      .text = "#made up\ntime[s] TT-x[cm] TT-y[cm]\n0.005 3.5 -1.25\n",
                      .options = sensors}};
}

}  // namespace genio
