#include "runs/frames/measured.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "inverse/recording/format_list.hpp"
#include "inverse/recording/frame_target.hpp"

namespace genio {
namespace {

constexpr double poor_fit = 3e-3;   // of the palate [m]
constexpr double poor_scale = 0.4;  // logarithm

/// "7" or "3-9"; empty means all.
std::pair<int, int> parse_frames(const std::string& text) {
  if (text.empty()) return {1, 1 << 30};
  int a = 0, b = 0;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%d-%d%c", &a, &b, &rest);
  if (n == 1 && text.find('-') == std::string::npos) b = a;
  else if (n != 2) a = 0;
  if (a < 1 || b < a)
    throw InputError(fmt::format("--frames {}: expected A-B with 1 <= A <= B", text));
  return {a, b};
}

/// "5=tip" to what the reader takes.
std::map<std::string, std::string> parsed_sensors(const std::vector<std::string>& sensors) {
  std::map<std::string, std::string> result;
  for (const std::string& s : sensors) {
    const auto equals = s.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == s.size())
      throw InputError(fmt::format("--sensors {}: expected SENSOR=PLACE, as in 5=tip", s));
    result[s.substr(0, equals)] = s.substr(equals + 1);
  }
  return result;
}

/// True where that format's files hold sensors: a palate trace beside them is of another.
bool names_sensors(const std::string& format) {
  return format != "auto" && format_named(format).traits.content == Content::sensors;
}

RegisteredFile registered_by(const Model& model, ContourFile file, const MeasuredOptions& o) {
  if (o.palate.empty())
    throw InputError(fmt::format(
        "{}: is in the device's own frame; give the same session's palate trace with --palate, or "
        "say --registered where it is in the model's",
        o.target));
  ReadOptions palate = o.read;
  palate.sensors.clear();
  if (!o.palate_sensor.empty()) palate.sensors[o.palate_sensor] = "palate";
  if (o.palate_sensor.empty() && names_sensors(o.read.format)) palate.format = "auto";
  RegisteredFile result = register_file(model, std::move(file), o.palate, palate);
  const Registration& r = result.registration;
  result.file.remarks.push_back(fmt::format(
      "registered by the palate: scale {:.3f}, tilt {:.1f} degrees, palate RMS {:.2f} mm",
      r.transform.scale, r.transform.angle * 180 / std::numbers::pi, 1e3 * r.palate_rms));
  if (r.palate_rms > poor_fit || std::abs(std::log(r.transform.scale)) > poor_scale)
    result.file.remarks.push_back(
        "THE REGISTRATION IS POOR: is the palate of the same session, units and axes as said?");
  return result;
}

}  // namespace

Measured read_measured(const MeasuredOptions& o, const std::function<const Model&()>& model,
                       const std::function<void(const std::string&)>& remark) {
  if (o.target.empty()) throw InputError("--target: a contour file is needed");
  if (!(o.noise_mm >= 0)) throw InputError("--noise-mm: must be above 0");
  const auto [first, last] = parse_frames(o.frames);
  ReadOptions read = o.read;
  read.sensors = parsed_sensors(o.sensors);
  ContourFile file = read_contours(o.target, read);
  Measured m;
  std::optional<Similarity> transform;
  if (!file.model_frame && !o.registered) {
    RegisteredFile r = registered_by(model(), std::move(file), o);
    file = std::move(r.file), transform = r.registration.transform;
  } else if (!file.facing_known) {
    throw InputError(o.target + ": does not say which way the face looks; give --facing");
  }
  for (const std::string& line : file.remarks) remark(fmt::format("{}: {}", o.target, line));
  m.noise = o.noise_mm > 0 ? 1e-3 * o.noise_mm : file.format.noise;
  for (const ContourFrame& frame : file.frames)
    if (frame.number >= first && frame.number <= last)
      m.frames.push_back(transform ? registered(model(), frame, *transform) : frame);
  if (m.frames.empty())
    throw InputError(fmt::format("--frames {}: {} has no such frame", o.frames, o.target));
  return m;
}

}  // namespace genio
