#include "runs/frames/measured.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "inverse/recording/base/curve_pieces.hpp"
#include "inverse/recording/base/file_axes.hpp"
#include "inverse/recording/format_list.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/recording/session/scan_session.hpp"
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

/// What is read of the files beside the target as it is of the target.
ReadOptions beside(ReadOptions read) {
  read.sensors.clear(), read.columns.clear(), read.points.clear(), read.spline.clear();
  return read;
}

using Remark = std::function<void(const std::string&)>;

void tell(const std::string& path, const ContourFile& file, const Remark& remark) {
  for (const std::string& line : file.remarks) remark(fmt::format("{}: {}", path, line));
}

std::optional<SessionFile> palate_of(const MeasuredOptions& o, const ReadOptions& read,
                                     const SessionFile& target, const Remark& remark) {
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
  std::optional<SessionFile> palate = read_palate(o.palate, options, target);
  tell(palate->path, palate->file, remark);
  return palate;
}

/// The file beside the model: by its palate, else by its contours.
AlignedRecording aligned(const Model& model, SessionFile target, const MeasuredOptions& o,
                         const ReadOptions& read, const Remark& remark) {
  const std::optional<SessionFile> palate = palate_of(o, read, target, remark);
  SessionMarks marks;
  if (!o.bite_plane.empty()) {
    ReadOptions options = beside(read);
    for (const std::string& sensor : o.bite_plane_sensors) options.sensors[sensor] = "bite plane";
    marks.bite_plane = read_bite_plane(o.bite_plane, options, target);
    tell(marks.bite_plane->path, marks.bite_plane->file, remark);
  }
  marks.points = head_points_of(target, given_head_points(o), !o.ignore_marks, read);
  return align(model, std::move(target), palate, read, marks);
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::string text_of(const RegistrationRecord& r) {
  const Judgement& j = r.judgement;
  const std::string palate =
      r.by_palate ? fmt::format(", palate RMS {:.2f} mm", 1e3 * j.palate_rms) : "";
  const std::string plane =
      r.bite_plane
          ? fmt::format(", bite plane {:.1f} degrees off the model's", degrees(*r.bite_plane))
          : "";
  std::string points;
  for (const auto& [point, off] : r.head_points)
    points += fmt::format(", {} {:.1f} mm from the model's", name_of(point), 1e3 * off);
  return fmt::format(
      "registered by the {}: scale {:.3f}, tilt {:.1f} degrees{}{}{}; {} {:.1f} mm from rest",
      r.by_palate  ? "palate"
      : j.sideways ? "shape alone"
                   : "contours alone",
      j.scale, degrees(j.tilt), palate, plane, points, j.sideways ? "the scan" : "contours",
      1e3 * j.from_rest);
}

/// What tells that the model is another speaker's; empty where it may be this one's.
std::string of_another(const RegistrationRecord& r) {
  constexpr double other_palate = 0.4e-3, other_size = 0.15;  // [m], of the logarithm
  const bool size = std::abs(std::log(r.judgement.scale)) > other_size;
  if (!size && !(r.by_palate && r.judgement.palate_rms > other_palate)) return {};
  return "the palate's shape or size is not the model's: forces are those of the model's anatomy, "
         "and they mislead where the palate is another speaker's than the tongue";
}

/// A file that is in the model's frame by itself, or so the caller says.
Measured as_given(const Model& model, ContourFile file, const MeasuredOptions& o) {
  if (!file.facing_known)
    throw InputError(o.target + ": does not say which way the face looks; give --facing");
  Measured m;
  m.registration = {.judgement = judge(model, {}, midsagittal_points(file), false),
                    .units = file.model_frame ? "mm" : file.units,
                    .axes = "the model's",
                    .points_order = points_order(file),
                    .by_palate = false,
                    .given = true};
  if (const auto surface = surface_points(file); !surface.empty()) {
    const Judgement scan = judge_scan(model, surface, {}, false);
    if (m.registration.judgement.faults.empty()) m.registration.judgement = scan;
  }
  Judgement& j = m.registration.judgement;
  if (j.faults.empty())
    if (std::string better = better_reading(model, file, j.from_rest); !better.empty())
      j.faults.push_back(std::move(better));
  m.frames = std::move(file.frames);
  return m;
}

/// How the registration went, and what it leaves open of the head's place, which is estimated
/// along.
void tell_registration(Measured& m, const HeadPosePrior& head, ContourFile& file,
                       const MeasuredOptions& o, const Remark& remark) {
  m.head_pose = head;
  file.remarks.push_back(text_of(m.registration));
  if (const std::string other = of_another(m.registration); !other.empty())
    file.remarks.push_back(other);
  file.remarks.push_back(fmt::format(
      "the head's place is estimated along, within {:.1f} mm and {:.0f} degrees{} (--registered "
      "where it is known)",
      1e3 * head.shift_sd, degrees(head.turn_sd),
      m.registration.by_palate ? "" : "; --palate tells more"));
  tell(o.target, file, remark);
}

Measured as_registered(const Model& model, AlignedRecording a, const MeasuredOptions& o,
                       const Remark& remark) {
  Measured m;
  m.registration = {.judgement = a.judgement,
                    .units = a.file.units,
                    .axes = a.reading.text(a.file.format.content),
                    .points_order = points_order(a.file),
                    .by_palate = !o.palate.empty(),
                    .bite_plane = a.bite_plane,
                    .head_points = a.head_points};
  tell_registration(m, {a.registration.shift_sd.maxCoeff(), a.registration.tilt_sd}, a.file, o,
                    remark);
  for (const ContourFrame& frame : a.file.frames)
    m.frames.push_back(registered(model, frame, a.registration.transform));
  return m;
}

Measured as_scan(const Model& model, SessionFile target, const MeasuredOptions& o,
                 const ReadOptions& read, const Remark& remark) {
  const std::optional<SessionFile> palate = palate_of(o, read, target, remark);
  AlignedScan a = align_scan(model, std::move(target), palate, read);
  Measured m;
  m.registration = {.judgement = a.judgement,
                    .units = a.file.units,
                    .axes = a.reading.text(Content::sensors),
                    .by_palate = palate.has_value()};
  tell_registration(m, {a.registration.shift_sd, a.registration.tilt_sd}, a.file, o, remark);
  m.frames = std::move(a.file.frames);
  return m;
}

/// Ends the work, or only says so where the caller insists.
void heed(Measured& m, const MeasuredOptions& o, const Remark& remark) {
  if (m.registration.judgement.faults.empty()) return;
  if (!o.force) throw RegistrationFailed(o.target, m.registration);
  m.registration.forced = true;
  remark(fmt::format("{}: THE REGISTRATION IS DOUBTFUL: {}", o.target,
                     faults_text(m.registration.judgement)));
}

}  // namespace

std::map<HeadPoint, std::string> given_head_points(const MeasuredOptions& o) {
  return {{HeadPoint::hyoid, o.hyoid},
          {HeadPoint::short_tendon, o.short_tendon},
          {HeadPoint::mandible, o.jaw_shadow}};
}

RegistrationFailed::RegistrationFailed(const std::string& path, RegistrationRecord what)
    : std::runtime_error(fmt::format("{}: cannot be laid beside the model: {} "
                                     "(--force-registration answers all the same)",
                                     path, faults_text(what.judgement))),
      record(std::move(what)) {}

Measured read_measured(const MeasuredOptions& o, const std::function<const Model&()>& model,
                       const std::function<void(const std::string&)>& remark) {
  if (o.target.empty()) throw InputError("--target: a contour file is needed");
  if (!(o.noise_mm >= 0)) throw InputError("--noise-mm: must be above 0");
  ReadOptions read = o.read;
  read.sensors = parsed_pairs(o.sensors, "--sensors", "SENSOR=PLACE, as in 5=tip");
  read.columns = parsed_pairs(o.columns, "--columns", "ROLE=TITLE, as in frame=uniqueframe");
  SessionFile target = read_session_file(o.target, read);
  const FormatTraits format = target.file.format;
  refuse_unused(o, format, target.file.model_frame);
  refuse_unused_pixels(o, target.axes);
  refuse_unused_noise(o, target.file.frames);
  // A wrong choice is said before the registration takes its time.
  const bool placed = target.file.model_frame || o.registered;
  const auto of_speaker = [&](std::vector<ContourFrame> frames) {
    if (placed && o.choice.speaker.empty()) return frames;
    return of_one_speaker(std::move(frames), o.choice, o.target);
  };
  target.file.frames = of_speaker(std::move(target.file.frames));
  chosen_frames(target.file.frames, o.choice, o.target, [](const std::string&) {});
  Measured m;
  if (placed) {
    ContourFile file = target.file.model_frame
                           ? std::move(target.file)
                           : with_one_curve_a_frame(read_contours(o.target, read), o.target);
    file.frames = of_speaker(std::move(file.frames));
    const std::vector<std::string> remarks = file.remarks;
    m = as_given(model(), std::move(file), o);
    for (const std::string& line : remarks) remark(fmt::format("{}: {}", o.target, line));
  } else {
    m = format.content == Content::surface
            ? as_scan(model(), std::move(target), o, read, remark)
            : as_registered(model(), aligned(model(), std::move(target), o, read, remark), o,
                            remark);
  }
  heed(m, o, remark);
  m.noise = o.noise_mm > 0 ? 1e-3 * o.noise_mm : format.noise;
  m.frames = chosen_frames(std::move(m.frames), o.choice, o.target, [&](const std::string& line) {
    remark(fmt::format("{}: {}", o.target, line));
  });
  return m;
}

}  // namespace genio
