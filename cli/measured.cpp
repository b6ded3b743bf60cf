#include "cli/measured.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "inverse/recording/formats/format_list.hpp"
#include "inverse/recording/frame_target.hpp"

namespace genio::cli {
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

/// "ema 0.5, surface 1, ...": what is assumed of each format [mm].
std::string usual_noises() {
  std::string list;
  for (const ContourFormat& format : contour_formats())
    list += fmt::format("{}{} {:g}", list.empty() ? "" : ", ", format.traits.name,
                        1e3 * format.traits.noise);
  return list;
}

}  // namespace

void add_measured_options(CLI::App& app, MeasuredOptions& o) {
  app.add_option("--target", o.target, "Contour file");
  app.add_option("--format", o.read.format, format_choices());
  app.add_option("--units", o.read.units, "mm, cm, m, um or px, where the file does not say");
  app.add_option("--mm-per-px", o.read.mm_per_px, "Size of a pixel")->check(CLI::PositiveNumber);
  app.add_option("--facing", o.read.facing, "Where the face looks in the file: left or right");
  app.add_option("--y-grows", o.read.up, "up, or down as in images");
  app.add_option("--sensors", o.sensors, "EMA: what each is stuck to, 3=dorsum,5=tip")
      ->delimiter(',');
  app.add_option("--rate-hz", o.read.rate_hz, "EMA: samples a second, where the file does not say")
      ->check(CLI::PositiveNumber);
  app.add_option("--palate", o.palate, "Palate trace of the same session");
  app.add_option("--palate-sensor", o.palate_sensor,
                 "EMA: the sensor swept along the palate there");
  app.add_flag("--registered", o.registered, "The file is in the model's frame already");
  app.add_option("--frames", o.frames, "A-B, counted from 1");
  app.add_option("--noise-mm", o.noise_mm,
                 fmt::format("Measurement noise (by the format: {})", usual_noises()));
}

Measured read_measured(const MeasuredOptions& o, const std::function<const Model&()>& model) {
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
  for (const std::string& remark : file.remarks) fmt::print(stderr, "{}: {}\n", o.target, remark);
  m.noise = o.noise_mm > 0 ? 1e-3 * o.noise_mm : file.format.noise;
  for (const ContourFrame& frame : file.frames)
    if (frame.number >= first && frame.number <= last)
      m.frames.push_back(transform ? registered(model(), frame, *transform) : frame);
  if (m.frames.empty())
    throw InputError(fmt::format("--frames {}: {} has no such frame", o.frames, o.target));
  return m;
}

void print_answer(const AnswerView& view, int frame, bool json) {
  if (json) fmt::print("{}\n", to_json(view, frame).dump());
  else fmt::print("{}\n{}\n", view.title, to_table(view));
  std::fflush(stdout);
}

std::string frame_name(const ContourFrame& frame) {
  return fmt::format("frame{:05d}", frame.number);
}

std::string frame_title(const ContourFrame& frame) {
  return fmt::format("frame {}{}{}", frame.number, frame.label.empty() ? "" : ": ", frame.label);
}

}  // namespace genio::cli
