#include "server/message_json.hpp"

#include <nlohmann/json.hpp>

#include "server/wire/wire.hpp"

namespace genio {
namespace {

using MessageJson = nlohmann::ordered_json;

MessageJson fields_of(const shape_request_t& r) {
  return {{"utime", r.utime},
          {"id", r.id},
          {"client", r.client},
          {"model", r.model},
          {"stream", r.stream},
          {"label", r.label},
          {"time_s", r.time_s},
          {"priority", r.priority},
          {"prior", r.prior},
          {"frame", r.frame},
          {"scale", r.scale},
          {"tilt_deg", r.tilt_deg},
          {"shift_x_mm", r.shift_x_mm},
          {"shift_z_mm", r.shift_z_mm},
          {"shift_sd_mm", r.shift_sd_mm},
          {"tilt_sd_deg", r.tilt_sd_deg},
          {"palate_count", r.palate_count},
          {"palate_x_mm", r.palate_x_mm},
          {"palate_z_mm", r.palate_z_mm},
          {"point_count", r.point_count},
          {"x_mm", r.x_mm},
          {"y_mm", r.y_mm},
          {"z_mm", r.z_mm},
          {"sigma_mm", r.sigma_mm},
          {"kind", r.kind},
          {"default_sigma_mm", r.default_sigma_mm},
          {"deadline_s", r.deadline_s},
          {"bilateral", int(r.bilateral)},
          {"starts", r.starts}};
}

MessageJson fields_of(const command_reply_t& r) {
  return {{"utime", r.utime},
          {"id", r.id},
          {"version", r.version},
          {"model", r.model},
          {"model_hash", r.model_hash},
          {"stream", r.stream},
          {"label", r.label},
          {"time_s", r.time_s},
          {"status", r.status},
          {"message", r.message},
          {"retry_after_s", r.retry_after_s},
          {"verdict", r.verdict},
          {"muscle_count", r.muscle_count},
          {"muscle", r.muscle},
          {"force_N", r.force_N},
          {"max_force_N", r.max_force_N},
          {"sd_N", r.sd_N},
          {"low_N", r.low_N},
          {"high_N", r.high_N},
          {"acts", r.acts},
          {"median_N", r.median_N},
          {"mean_N", r.mean_N},
          {"information_bits", r.information_bits},
          {"mirrored", r.mirrored},
          {"mixed_optima", r.mixed_optima},
          {"other_count", r.other_count},
          {"other", r.other},
          {"other_unit", r.other_unit},
          {"other_value", r.other_value},
          {"other_sd", r.other_sd},
          {"other_low", r.other_low},
          {"other_high", r.other_high},
          {"trade_count", r.trade_count},
          {"trade_group", r.trade_group},
          {"trade_muscle", r.trade_muscle},
          {"trade_amount_N", r.trade_amount_N},
          {"group_count", r.group_count},
          {"unidentified", r.unidentified},
          {"either_count", r.either_count},
          {"either", r.either},
          {"either_acts", r.either_acts},
          {"either_low_N", r.either_low_N},
          {"either_high_N", r.either_high_N},
          {"rms_mm", r.rms_mm},
          {"max_mm", r.max_mm},
          {"chi2_per_dof", r.chi2_per_dof},
          {"ipopt_iterations", r.ipopt_iterations},
          {"factorizations", r.factorizations},
          {"wall_s", r.wall_s},
          {"waited_s", r.waited_s},
          {"tries", r.tries},
          {"registration", r.registration},
          {"scale", r.scale},
          {"tilt_deg", r.tilt_deg},
          {"shift_x_mm", r.shift_x_mm},
          {"shift_z_mm", r.shift_z_mm},
          {"shift_sd_mm", r.shift_sd_mm},
          {"tilt_sd_deg", r.tilt_sd_deg},
          {"line_count", r.line_count},
          {"line_x_mm", r.line_x_mm},
          {"line_z_mm", r.line_z_mm},
          {"weight", r.weight},
          {"alternative_count", r.alternative_count},
          {"alternative_weight", r.alternative_weight},
          {"alternative_rms_mm", r.alternative_rms_mm},
          {"alternative_force_count", r.alternative_force_count},
          {"alternative_force_N", r.alternative_force_N}};
}

template <class T>
std::optional<std::string> message_json(const std::vector<uint8_t>& bytes, std::string& why) {
  const auto message = decode_checked<T>(bytes.data(), bytes.size(), why);
  if (!message) return std::nullopt;
  return fields_of(*message).dump(-1, ' ', false, MessageJson::error_handler_t::replace);
}

}  // namespace

std::optional<std::string> request_json(const std::vector<uint8_t>& bytes, std::string& why) {
  return message_json<shape_request_t>(bytes, why);
}

std::optional<std::string> reply_json(const std::vector<uint8_t>& bytes, std::string& why) {
  return message_json<command_reply_t>(bytes, why);
}

}  // namespace genio
