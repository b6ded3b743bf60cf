#include "runs/frames/measured.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "inverse/recording/base/curve_pieces.hpp"
#include "inverse/recording/base/file_axes.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/recording/session/scan_session.hpp"
#include "runs/frames/session_options.hpp"

namespace genio {
namespace {

using Remark = std::function<void(const std::string&)>;

void tell(const std::string& path, const ContourFile& file, const Remark& remark) {
  for (const std::string& line : file.remarks) remark(fmt::format("{}: {}", path, line));
}

std::optional<SessionFile> told_palate(const MeasuredOptions& o, const ReadOptions& read,
                                       const SessionFile& target, const Remark& remark) {
  std::optional<SessionFile> palate = palate_of(o, read, target);
  if (palate) tell(palate->path, palate->file, remark);
  return palate;
}

/// The file beside the model: by its palate, else by its contours.
AlignedRecording aligned(const Model& model, SessionFile target, const MeasuredOptions& o,
                         const ReadOptions& read, const Remark& remark) {
  const std::optional<SessionFile> palate = told_palate(o, read, target, remark);
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
  m.registration = record_of(a, !o.palate.empty());
  tell_registration(m, head_pose_of(a.registration), a.file, o, remark);
  m.transform = a.registration.transform;
  m.frames = std::move(a.file.frames);
  if (!o.as_seen)
    for (ContourFrame& frame : m.frames) frame = registered(model, frame, *m.transform);
  return m;
}

Measured as_scan(const Model& model, SessionFile target, const MeasuredOptions& o,
                 const ReadOptions& read, const Remark& remark) {
  const std::optional<SessionFile> palate = told_palate(o, read, target, remark);
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

double noise_of(const MeasuredOptions& o, const FormatTraits& format) {
  return o.noise_mm > 0 ? 1e-3 * o.noise_mm : format.noise;
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
  const ReadOptions read = read_options_of(o);
  SessionFile target = target_of(o, read);
  const FormatTraits format = target.file.format;
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
  m.noise = noise_of(o, format);
  m.frames = chosen_frames(std::move(m.frames), o.choice, o.target, [&](const std::string& line) {
    remark(fmt::format("{}: {}", o.target, line));
  });
  return m;
}

Unregistered read_unregistered(const MeasuredOptions& o,
                               const std::function<void(const std::string&)>& remark) {
  const ReadOptions read = read_options_of(o);
  SessionFile target = target_of(o, read);
  const FormatTraits format = target.file.format;
  if (target.file.model_frame)
    throw InputError(fmt::format("{}: is read as {}, which is in the model's frame already",
                                 o.target, format.name));
  if (format.content == Content::surface)
    throw InputError(o.target + ": is a scan, which can be registered here alone");
  const AxesReading axes = said_axes(target, read);
  target.file.frames = of_one_speaker(std::move(target.file.frames), o.choice, o.target);
  const std::optional<SessionFile> palate = told_palate(o, read, target, remark);
  Unregistered u;
  u.noise = noise_of(o, format);
  if (palate) u.palate = trace_of(turned(palate->file, axes));
  tell(o.target, target.file, remark);
  u.frames = turned(std::move(target.file), axes).frames;
  u.frames = chosen_frames(std::move(u.frames), o.choice, o.target, [&](const std::string& line) {
    remark(fmt::format("{}: {}", o.target, line));
  });
  return u;
}

}  // namespace genio
