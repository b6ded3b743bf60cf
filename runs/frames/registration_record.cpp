#include "runs/frames/registration_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "inverse/recording/base/file_axes.hpp"

namespace genio {

namespace {

/// "short_tendon_off_mm"
std::string key_of(HeadPoint point) {
  std::string key = name_of(point);
  std::replace(key.begin(), key.end(), ' ', '_');
  return key + "_off_mm";
}

}  // namespace

std::string faults_text(const Judgement& judgement) {
  return fmt::format("{}", fmt::join(judgement.faults, "; "));
}

RegistrationRecord record_of(const AlignedRecording& a, bool by_palate) {
  return {.judgement = a.judgement,
          .units = a.file.units,
          .axes = a.reading.text(a.file.format.content),
          .points_order = points_order(a.file),
          .by_palate = by_palate,
          .bite_plane = a.bite_plane,
          .head_points = a.head_points};
}

HeadPosePrior head_pose_of(const Registration& registration) {
  return {registration.shift_sd.maxCoeff(), registration.tilt_sd};
}

nlohmann::json registration_json(const RegistrationRecord& r) {
  const Judgement& j = r.judgement;
  nlohmann::json json = {{"scale", j.scale},
                         {"tilt_deg", j.tilt * 180 / std::numbers::pi},
                         {"shift_mm", {1e3 * j.shift[0], 1e3 * j.shift[1]}},
                         {"palate_rms_mm", nullptr},
                         {"bite_plane_deg", nullptr},
                         {"hyoid_off_mm", nullptr},
                         {"short_tendon_off_mm", nullptr},
                         {"mandible_off_mm", nullptr},
                         {"from_rest_mm", 1e3 * j.from_rest},
                         {"off_reach_mm", nullptr},
                         {"behind_palate", j.behind_palate},
                         {"units", r.units},
                         {"axes", r.axes},
                         {"points_order", nullptr},
                         {"by", r.given       ? "given"
                                : r.by_palate ? "palate"
                                : j.sideways  ? "shape"
                                              : "contours"},
                         {"doubtful", !j.faults.empty()},
                         {"reason", faults_text(j)},
                         {"forced", r.forced}};
  if (!r.given) json["off_reach_mm"] = 1e3 * j.off_reach;
  if (!r.points_order.empty()) json["points_order"] = r.points_order;
  if (r.by_palate && !r.given) json["palate_rms_mm"] = 1e3 * j.palate_rms;
  if (j.sideways) {
    json["roll_deg"] = (*j.sideways)[0] * 180 / std::numbers::pi;
    json["yaw_deg"] = (*j.sideways)[1] * 180 / std::numbers::pi;
    json["lateral_mm"] = 1e3 * (*j.sideways)[2];
  }
  if (r.bite_plane) json["bite_plane_deg"] = *r.bite_plane * 180 / std::numbers::pi;
  for (const auto& [point, off] : r.head_points) json[key_of(point)] = 1e3 * off;
  return json;
}

AnswerView with_registration(AnswerView view, const RegistrationRecord& record) {
  return with_registration(std::move(view), registration_json(record).dump(), record.forced);
}

AnswerView with_registration(AnswerView view, const std::string& registration, bool forced) {
  view.registration = registration;
  if (!forced) return view;
  view.title += " (the registration is doubtful)";
  if (view.verdict != "none") {
    view.verdict = "none";
    view.message = fmt::format("no verdict, as the registration is doubtful ({})", view.message);
  }
  return view;
}

std::string no_forces_json(const std::string& message, const RegistrationRecord& record) {
  return nlohmann::json{
      {"status", "failed"}, {"message", message}, {"registration", registration_json(record)}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace genio
