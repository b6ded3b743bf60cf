#include "server/answer/fill_reply.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "server/base/safe_text.hpp"

namespace genio {
namespace {

constexpr size_t longest_reason = 2000;  // bytes

void fill_muscles(const std::vector<Estimate>& muscles, command_reply_t& reply) {
  for (const Estimate& c : muscles) {
    reply.muscle.push_back(c.name);
    reply.force_N.push_back(c.best);
    reply.max_force_N.push_back(c.maximum);
    reply.sd_N.push_back(c.sd);
    reply.low_N.push_back(c.low);
    reply.high_N.push_back(c.high);
    reply.acts.push_back(c.acts);
    reply.median_N.push_back(c.median);
    reply.mean_N.push_back(c.mean);
    reply.information_bits.push_back(c.information_bits);
  }
  reply.muscle_count = int(reply.muscle.size());
}

void fill_others(const std::vector<Estimate>& others, command_reply_t& reply) {
  for (const Estimate& c : others) {
    reply.other.push_back(c.name);
    reply.other_unit.push_back(c.unit);
    reply.other_value.push_back(c.best);
    reply.other_sd.push_back(c.sd);
    reply.other_low.push_back(c.low);
    reply.other_high.push_back(c.high);
  }
  reply.other_count = int(reply.other.size());
}

void fill_trades(const std::vector<TradeOff>& trades, command_reply_t& reply) {
  for (size_t group = 0; group < trades.size(); ++group) {
    reply.unidentified.push_back(fmt::format("{}", fmt::join(names(trades[group]), "+")));
    for (const Share& share : trades[group]) {
      reply.trade_group.push_back(int(group));
      reply.trade_muscle.push_back(share.name);
      reply.trade_amount_N.push_back(share.amount);
    }
  }
  reply.group_count = int(reply.unidentified.size());
  reply.trade_count = int(reply.trade_group.size());
}

void fill_joint(const std::vector<JointForce>& joint, command_reply_t& reply) {
  for (const JointForce& either : joint) {
    reply.either.push_back(fmt::format("{}", fmt::join(either.names, "+")));
    reply.either_acts.push_back(either.acts);
    reply.either_low_N.push_back(either.low), reply.either_high_N.push_back(either.high);
  }
  reply.either_count = int(reply.either.size());
}

void fill_alternatives(const std::vector<Alternative>& alternatives, command_reply_t& reply) {
  for (const Alternative& other : alternatives) {
    reply.alternative_weight.push_back(other.weight);
    reply.alternative_rms_mm.push_back(1e3 * other.rms);
    for (const auto& c : other.muscles) reply.alternative_force_N.push_back(c.best);
  }
  reply.alternative_count = int(reply.alternative_weight.size());
  reply.alternative_force_count = int(reply.alternative_force_N.size());
}

}  // namespace

void fill_answer(const TongueLine& line, const Answer& a, command_reply_t& reply) {
  reply.verdict = to_string(a.verdict);
  fill_muscles(a.muscles, reply);
  fill_others(a.others, reply);
  reply.mirrored = a.mirrored.value_or(std::nan(""));
  reply.mixed_optima = a.mixed_optima;
  fill_trades(a.unidentified, reply);
  fill_joint(a.joint, reply);
  reply.rms_mm = 1e3 * a.rms, reply.max_mm = 1e3 * a.max, reply.chi2_per_dof = a.chi2_per_dof;
  if (a.shape.size() > 0)
    for (const Vec2& p : line.sample(a.shape, 80)) {
      reply.line_x_mm.push_back(1e3 * p[0]);
      reply.line_z_mm.push_back(1e3 * p[1]);
    }
  reply.line_count = int(reply.line_x_mm.size());
  reply.weight = a.weight;
  fill_alternatives(a.alternatives, reply);
}

void fill_placement(const std::optional<RequestPlacement>& placement, command_reply_t& reply) {
  if (!placement) return;
  put_place(placement->place, reply);
  reply.registration = registration_json(placement->record)
                           .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void withhold_doubtful_verdict(const std::optional<RequestPlacement>& placement,
                               command_reply_t& reply) {
  if (!placement || !placement->record.forced || reply.verdict == "none") return;
  reply.verdict = "none";
  reply.message = fmt::format("no verdict, as the place of the points is doubtful: {} ({})",
                              faults_text(placement->record.judgement), reply.message);
}

std::string reason_text(const std::string& reason) {
  std::string text = escaped_text(reason);
  if (text.size() > longest_reason) text = std::string(cut_text(text, longest_reason)) + "...";
  return text;
}

}  // namespace genio
