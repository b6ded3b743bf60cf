#include "inverse/recording/samples/sensor_frames.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "forward/base/input_file.hpp"
#include "inverse/recording/base/confidence.hpp"
#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/samples/bad_samples.hpp"

namespace genio {
namespace {

std::string sensor_list(const SensorTable& table) {
  std::string list;
  for (size_t c = 0; c < table.names.size(); ++c) {
    Vec3 sum = Vec3::Zero();
    int seen = 0;
    for (const auto& row : table.samples)
      if (row[c].allFinite()) sum += row[c], ++seen;
    list += seen == 0 ? fmt::format(" {}: never on;", table.names[c])
                      : fmt::format(" {}: about ({:.1f}, {:.1f}, {:.1f});", table.names[c],
                                    sum[0] / seen, sum[1] / seen, sum[2] / seen);
  }
  if (!list.empty()) list.pop_back();
  for (const std::string& remark : table.remarks) list += "; " + remark;
  return list;
}

/// What sensors on a plate between the teeth are called: OS, MS (the incisors' and the molars'),
/// BP.
bool is_on_plate(const std::string& name) {
  const std::string text = lower_case(name);
  return text == "os" || text == "ms" || text.starts_with("bp") || text.starts_with("bite") ||
         text.starts_with("occl");
}

/// With the sensors of a bite plane by their names, where the caller gives none.
ReadOptions with_plate(const SensorTable& table, ReadOptions o) {
  if (o.role != "bite plane" || !o.sensors.empty()) return o;
  for (const std::string& name : table.names)
    if (is_on_plate(name)) o.sensors[name] = o.role;
  return o;
}

}  // namespace

RawContours sensor_frames(const std::string& path, SensorTable table, const ReadOptions& options) {
  const ReadOptions o = with_plate(table, options);
  if (table.samples.empty()) throw InputError(path + ": the file has no sample");
  if (o.sensors.empty() && o.role == "bite plane")
    throw InputError(fmt::format(
        "{}: say which of its sensors lie on the bite plane, --bite-plane-sensors OS,MS; it has{}",
        path, sensor_list(table)));
  if (o.sensors.empty())
    throw InputError(fmt::format(
        "{}: say what its sensors are stuck to, --sensors 5=tip+3mm,3=dorsum (tip, blade, "
        "dorsum, root, a length behind one of them, node:N); it has{}",
        path, sensor_list(table)));
  std::vector<std::pair<size_t, std::string>> used;
  for (const auto& [sensor, what] : o.sensors) {
    const auto it = std::find(table.names.begin(), table.names.end(), sensor);
    if (it == table.names.end())
      throw InputError(
          fmt::format("--sensors {}={}: {} has{}", sensor, what, path, sensor_list(table)));
    used.emplace_back(size_t(it - table.names.begin()), what);
  }
  const double rate = o.rate_hz > 0 ? o.rate_hz : table.rate_hz;
  for (const auto& [c, what] : used) {
    drop_bad_samples(table, c, what != "palate" && what != "bite plane");
    if (std::none_of(table.samples.begin(), table.samples.end(),
                     [&, c = c](const auto& row) { return row[c].allFinite(); }))
      table.remarks.push_back(fmt::format("sensor {} ({}) has no value", table.names[c], what));
  }
  RawContours raw{{}, table.axes};
  raw.file.model_frame = false;
  raw.file.remarks = std::move(table.remarks);
  if (rate == 0 && table.times_s.empty())
    raw.file.remarks.push_back("no sampling rate in the file: times are 0 (--rate-hz)");
  for (size_t s = 0; s < table.samples.size(); ++s) {
    ContourFrame& frame = raw.file.frames.emplace_back();
    frame.number = int(s) + 1, frame.recording = table.recording;
    if (s < table.labels.size()) frame.label = table.labels[s];
    if (s < table.times_s.size()) frame.time_s = table.times_s[s];
    else if (rate > 0) frame.time_s = double(s) / rate;
    for (const auto& [c, what] : used) {
      const Vec3& p = table.samples[s][c];
      if (!p.allFinite()) continue;
      ContourPoint& point = frame.points.emplace_back();
      point.position = p, point.kind = what;
      if (s < table.rms.size()) point.widening = widening_by_residual(table.rms[s][c]);
    }
    if (frame.points.empty()) frame.note = "no sensor has a value";
  }
  return raw;
}

std::string sensor_file_bytes(const std::string& path) { return read_file(path, largest_input); }

}  // namespace genio
