#include "runs/frames/session_options.hpp"

#include <fmt/format.h>

#include "inverse/recording/base/axes_reading.hpp"
#include "inverse/recording/format_list.hpp"
#include "runs/frames/unused_options.hpp"

namespace genio {
namespace {

/// "5=tip" to what the reader takes; `expected` is what the option's values look like.
std::map<std::string, std::string> parsed_pairs(const std::vector<std::string>& pairs,
                                                const char* option, const char* expected) {
  std::map<std::string, std::string> result;
  for (const std::string& s : pairs) {
    const auto equals = s.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == s.size())
      throw InputError(fmt::format("{} {}: expected {}", option, s, expected));
    result[s.substr(0, equals)] = s.substr(equals + 1);
  }
  return result;
}

/// True where that format's files hold sensors: a palate trace beside them is of another.
bool names_sensors(const std::string& format) {
  return format != "auto" && format_named(format).traits.content == Content::sensors;
}

}  // namespace

ReadOptions read_options_of(const MeasuredOptions& o) {
  if (o.target.empty()) throw InputError("--target: a contour file is needed");
  if (!(o.noise_mm >= 0)) throw InputError("--noise-mm: must be above 0");
  ReadOptions read = o.read;
  read.sensors = parsed_pairs(o.sensors, "--sensors", "SENSOR=PLACE, as in 5=tip");
  read.columns = parsed_pairs(o.columns, "--columns", "ROLE=TITLE, as in frame=uniqueframe");
  return read;
}

ReadOptions beside(ReadOptions read) {
  read.sensors.clear(), read.columns.clear(), read.points.clear(), read.spline.clear();
  return read;
}

SessionFile target_of(const MeasuredOptions& o, const ReadOptions& read) {
  SessionFile target = read_session_file(o.target, read);
  refuse_unused(o, target.file.format, target.file.model_frame);
  refuse_unused_pixels(o, target.axes);
  refuse_unused_noise(o, target.file.frames);
  return target;
}

std::optional<SessionFile> palate_of(const MeasuredOptions& o, const ReadOptions& read,
                                     const SessionFile& target) {
  if (o.palate.empty()) return {};
  ReadOptions options = beside(read);
  options.spline = o.palate_spline;
  if (!o.palate_sensor.empty()) options.sensors[o.palate_sensor] = "palate";
  // A trace beside sensors is of another format, unless it is a sensor's sweep.
  if (o.palate_sensor.empty() && names_sensors(o.read.format)) options.format = "auto";
  if (!o.palate_format.empty()) options.format = o.palate_format;
  if (!o.palate_units.empty()) {
    options.units = o.palate_units;
    if (o.palate_units != "px") options.mm_per_px = 0;
  }
  return read_palate(o.palate, options, target);
}

AxesReading said_axes(const SessionFile& target, const ReadOptions& read) {
  if (!read.axes.empty()) return parse_axes(read.axes);
  const std::string facing = read.facing.empty() ? target.axes.facing : read.facing;
  const std::string up = read.up.empty() ? target.axes.up : read.up;
  if (facing.empty())
    throw InputError(target.path + ": does not say which way the face looks; give --facing");
  if (up.empty()) throw InputError(target.path + ": does not say where y grows to; give --y-grows");
  return {.back_grows = facing == "left", .up_grows = up == "up"};
}

}  // namespace genio
