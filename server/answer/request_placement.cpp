#include "server/answer/request_placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inverse/recording/base/curve_pieces.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/recording/session/scan_session.hpp"
#include "server/answer/request_points.hpp"
#include "server/dispatch/admission.hpp"

namespace genio {
namespace {

constexpr const char* promised_axes = "+x+z";  // back and up

bool on_surface(const ContourPoint& p) { return p.kind == "surface"; }

/// One frame as a file of a session would be read: in millimetres, which its size has to agree
/// with.
SessionFile session_of(const char* name, ContourFrame frame, Content content) {
  for (ContourPoint& p : frame.points) p.position *= 1e3, p.sigma *= 1e3;
  RawContours raw{.file = {}, .axes = FileAxes{"mm", "left", "up"}};
  raw.file.format = {.name = name, .content = content};
  raw.file.frames = {std::move(frame)};
  return session_file(name, std::move(raw), {});
}

/// Without points that are none of the curve, as recordings are read.
ContourFrame one_curve(ContourFrame frame) {
  ContourFile file;
  file.frames = {std::move(frame)};
  return with_one_curve_a_frame(std::move(file), "points").frames.front();
}

ContourFrame placed(const Model& model, const ContourFrame& frame, const Similarity& transform) {
  ContourFrame result = registered(model, frame, transform);
  for (ContourPoint& p : result.points) p.position[1] *= transform.scale;
  return result;
}

RequestPlacement placement_by_numbers(const Model& model, const shape_request_t& r,
                                      const ContourFrame& frame) {
  RequestPlacement placement;
  placement.place = place_in(r);
  const auto& [transform, head] = placement.place;
  const auto [shift, turn] = head;
  if (!(shift >= 0 && turn >= 0 && std::isfinite(shift + turn) && (shift > 0) == (turn > 0)))
    throw InputError(
        "shift_sd_mm and tilt_sd_deg: expected both above 0, or both 0 where the place is known");
  ContourFile file;
  file.frames = {frame};
  Registration known{.transform = transform};
  known.shift_sd = Vec2::Constant(shift);
  placement.record = {.judgement = judge(model, known, midsagittal_points(file), false),
                      .units = "mm",
                      .axes = AxesReading{}.text(Content::curves),
                      .points_order = points_order(file),
                      .by_palate = false,
                      .given = true};
  file.frames = {placed(model, frame, transform)};
  if (const auto scan = surface_points(file); !scan.empty())
    if (const Judgement j = judge_scan(model, scan, {}, false);
        placement.record.judgement.faults.empty()) {
      placement.record.judgement.from_rest = j.from_rest;
      placement.record.judgement.behind_palate = j.behind_palate;
      placement.record.judgement.faults = j.faults;
    }
  placement.record.forced = !placement.record.judgement.faults.empty();
  return placement;
}

/// Points that are all of flesh are a recording of sensors.
Content content_of(const ContourFrame& frame) {
  const bool curves = std::any_of(frame.points.begin(), frame.points.end(),
                                  [](const auto& p) { return p.kind == "curve"; });
  return curves ? Content::curves : Content::sensors;
}

RequestPlacement placement_by_registration(const Model& model, const shape_request_t& r,
                                           ContourFrame frame, const TongueReach& reach) {
  for (ContourPoint& p : frame.points) p.position[1] = 0;  // what is across tells nothing of axes
  const Content content = content_of(frame);
  SessionFile target = session_of("points", std::move(frame), content);
  std::optional<SessionFile> palate;
  if (r.palate_count > 0) palate = session_of("palate", palate_of(r), Content::curves);
  ReadOptions said;
  said.axes = promised_axes;
  const AlignedRecording a = align(model, reach, std::move(target), palate, said);
  RequestPlacement placement{{a.registration.transform, head_pose_of(a.registration)},
                             record_of(a, palate.has_value())};
  // Who sends points says which way they are turned, and is no witness to it.
  if (a.turned_fits_better)
    placement.record.judgement.faults.emplace_back(
        "turned or mirrored it fits better: does x run backwards and z up? A palate would tell, "
        "and where the place is known the frame is 'placed'");
  return placement;
}

}  // namespace

LaidPoints laid_points(const Model& model, const shape_request_t& r,
                       const std::function<TongueReach()>& reach) {
  ContourFrame frame = points_of(r);
  if (r.frame.empty() || r.frame == "model" || frame.points.empty()) return {std::move(frame), {}};
  if (const std::string fault = fault_of_frame(r); !fault.empty()) throw InputError(fault);
  LaidPoints laid;
  if (r.frame == "device") {
    const auto surface = std::find_if(frame.points.begin(), frame.points.end(), on_surface);
    if (surface != frame.points.end())
      throw InputError(
          fmt::format("point {}: a surface point cannot be registered; expected the kind 'curve' "
                      "or a flesh point, or points in the frame 'model' or 'placed'",
                      surface - frame.points.begin() + 1));
    laid.placement = placement_by_registration(model, r, frame, reach());
  } else {
    laid.placement = placement_by_numbers(model, r, one_curve(frame));
  }
  if (const RegistrationRecord& record = laid.placement->record;
      record.forced || record.judgement.faults.empty())
    laid.frame = placed(model, one_curve(std::move(frame)), laid.placement->place.transform);
  return laid;
}

}  // namespace genio
