#include "cli/service/request_message.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "forward/base/thin.hpp"
#include "runs/frames/frame.hpp"
#include "server/answer/message_place.hpp"

namespace genio::cli {
namespace {

/// Names that stand joined by '+'.
std::vector<std::string> parted(const std::string& joined) {
  std::vector<std::string> names(1);
  for (char c : joined)
    if (c == '+') names.emplace_back();
    else names.back() += c;
  return names;
}

std::vector<Estimate> muscles_of(const command_reply_t& r) {
  std::vector<Estimate> muscles;
  for (size_t i = 0; i < r.muscle.size(); ++i)
    muscles.push_back({.name = r.muscle[i],
                       .best = r.force_N[i],
                       .maximum = r.max_force_N[i],
                       .acts = r.acts[i],
                       .median = r.median_N[i],
                       .mean = r.mean_N[i],
                       .sd = r.sd_N[i],
                       .low = r.low_N[i],
                       .high = r.high_N[i],
                       .information_bits = r.information_bits[i]});
  return muscles;
}

std::vector<Estimate> others_of(const command_reply_t& r) {
  std::vector<Estimate> others;
  for (size_t i = 0; i < r.other.size(); ++i)
    others.push_back({.name = r.other[i],
                      .best = r.other_value[i],
                      .unit = r.other_unit[i],
                      .kind = r.other[i].starts_with("head_pose.") ? Unknown::Kind::pose
                                                                   : Unknown::Kind::parameter,
                      .sd = r.other_sd[i],
                      .low = r.other_low[i],
                      .high = r.other_high[i]});
  return others;
}

}  // namespace

void put_frame(const ContourFrame& frame, double noise, shape_request_t& r) {
  r.time_s = frame.time_s, r.label = frame.label;
  for (const auto& p : frame.points) {
    r.x_mm.push_back(1e3 * p.position[0]);
    r.y_mm.push_back(1e3 * p.position[1]);
    r.z_mm.push_back(1e3 * p.position[2]);
    r.sigma_mm.push_back(1e3 * (p.sigma > 0 ? p.sigma : p.widening * noise));
    r.kind.push_back(p.kind);
  }
  r.point_count = int(frame.points.size());
  r.default_sigma_mm = 1e3 * noise;
}

void put_palate(const std::vector<Vec2>& trace, shape_request_t& r) {
  r.frame = "device";
  for (const Vec2& q : thin(trace, size_t(max_array_length))) {
    r.palate_x_mm.push_back(1e3 * q[0]);
    r.palate_z_mm.push_back(1e3 * q[1]);
  }
  r.palate_count = int(r.palate_x_mm.size());
}

std::optional<Similarity> place_in_reply(const command_reply_t& r) {
  if (r.registration.empty() || !std::isfinite(r.scale)) return {};
  return place_in(r).transform;
}

std::string registration_line(const command_reply_t& r) {
  const auto json = nlohmann::json::parse(r.registration, nullptr, false);
  if (!json.is_object() || !place_in_reply(r)) return {};
  const auto by = json.find("by"), rms = json.find("palate_rms_mm");
  return fmt::format(
      "registered by the {}: scale {:.3f}, tilt {:.1f} degrees{}; the head's place is estimated "
      "along, within {:.1f} mm and {:.0f} degrees",
      by != json.end() && by->is_string() ? by->get<std::string>() : "server", r.scale, r.tilt_deg,
      rms != json.end() && rms->is_number()
          ? fmt::format(", palate RMS {:.2f} mm", rms->get<double>())
          : "",
      r.shift_sd_mm, r.tilt_sd_deg);
}

AnswerView view_of(const command_reply_t& r, const ContourFrame& frame) {
  AnswerView v;
  tell_frame(frame, v);
  v.status = r.status, v.message = r.message, v.verdict = r.verdict;
  v.muscles = muscles_of(r), v.others = others_of(r);
  for (const auto& group : r.unidentified) v.unidentified.push_back(parted(group));
  v.trade_offs.resize(r.unidentified.size());
  for (size_t k = 0; k < r.trade_group.size(); ++k)
    if (const auto group = size_t(r.trade_group[k]); group < v.trade_offs.size())
      v.trade_offs[group].push_back({r.trade_muscle[k], r.trade_amount_N[k]});
  if (!std::isnan(r.mirrored)) v.mirrored = r.mirrored;
  v.mixed_optima = r.mixed_optima;
  for (size_t k = 0; k < r.either.size(); ++k)
    v.joint.push_back(
        {parted(r.either[k]), r.either_acts[k], r.either_low_N[k], r.either_high_N[k]});
  v.rms_mm = r.rms_mm, v.max_mm = r.max_mm, v.chi2_per_dof = r.chi2_per_dof;
  v.weight = r.weight;
  const size_t muscles = r.muscle.size();
  for (size_t k = 0; k < r.alternative_weight.size(); ++k) {
    Alternative other{r.alternative_weight[k], v.muscles, 1e-3 * r.alternative_rms_mm[k], {}};
    for (size_t i = 0; i < muscles && k * muscles + i < r.alternative_force_N.size(); ++i)
      other.muscles[i].best = r.alternative_force_N[k * muscles + i];
    v.alternatives.push_back(std::move(other));
  }
  v.iterations = r.ipopt_iterations, v.factorizations = r.factorizations, v.wall_s = r.wall_s;
  for (const auto& p : frame.points) v.measured.emplace_back(p.position[0], p.position[2]);
  for (size_t i = 0; i < r.line_x_mm.size(); ++i)
    v.predicted.emplace_back(1e-3 * r.line_x_mm[i], 1e-3 * r.line_z_mm[i]);
  return v;
}

}  // namespace genio::cli
