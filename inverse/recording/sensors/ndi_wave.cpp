#include "inverse/recording/sensors/ndi_wave.hpp"

#include <fmt/format.h>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/samples/sensor_channels.hpp"

namespace genio {
namespace {

constexpr size_t state = 2, position = 7, width = 10;  // of a sensor's columns

RawContours read(const std::string& path, const ReadOptions& o) {
  TableLines lines(path);
  SensorTable table;
  std::vector<size_t> first;  // a sensor's first column
  std::string line;
  while (lines.next(line) && trimmed(line).empty()) {
  }
  const auto titles = sensor_fields(line);
  for (size_t k = 0; k + width <= titles.size(); ++k)
    if (titles[k + 1] == "Frame" && titles[k + state] == "State" && titles[k + position] == "Tx") {
      first.push_back(k), table.names.push_back(titles[k]);
      k += width - 1;
    }
  if (first.empty())
    lines.fail("expected Wav Time, then NAME Frame State Q0 Qx Qy Qz Tx Ty Tz a sensor");
  TableNumbers numbers('\t');
  int unseen = 0;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const auto fields = sensor_fields(line);
    if (fields.size() > titles.size() || fields.size() < first.back() + width)
      lines.fail(other_count(fields.size(), "header", titles.size(), line));
    const double time = numbers.value(fields[0], lines);
    if (!(time == time)) lines.fail("no time in the first column");
    table.times_s.push_back(time);
    auto& row = table.samples.emplace_back();
    for (const size_t k : first) {
      const bool seen = fields[k + state] == "OK" || fields[k + state].empty();
      unseen += !seen;
      const double nan = std::numeric_limits<double>::quiet_NaN();
      double v[3] = {nan, nan, nan};
      for (size_t i = 0; seen && i < 3; ++i) v[i] = numbers.value(fields[k + position + i], lines);
      row.push_back(sensor_position(v[0], v[1], v[2]));
    }
  }
  if (unseen > 0)
    table.remarks.push_back(fmt::format("{} of {} values left out: their State is not OK", unseen,
                                        first.size() * table.samples.size()));
  return sensor_frames(path, std::move(table), o);
}

}  // namespace

ContourFormat ndi_wave_format() {
  ReadOptions sensors;
  sensors.sensors = {{"TT", "tip"}};
  return {.traits = {.name = "ndi-wave", .content = Content::sensors},
          .about = "NDI Wave tables",
          .known_by_bytes = {},
          .known_by_line =
              [](const FileStart& start) {
                return start.line.find("State") != std::string::npos &&
                       start.line.find("Tx") != std::string::npos &&
                       start.line.find("Q0") != std::string::npos;
              },
          .read = read,
          .example = {.name = "take.tsv",
                      .text = "Wav Time\tTT\tFrame\tState\tQ0\tQx\tQy\tQz\tTx\tTy\tTz\n"
                              "0.01\t\t1\tOK\t1\t0\t0\t0\t12.5\t1\t-3.25\n",
                      .options = sensors}};
}

}  // namespace genio
