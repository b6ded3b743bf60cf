#include "server/answer/answer_request.hpp"

#include <fmt/format.h>

#include <cmath>
#include <new>

#include "forward/base/elapsed.hpp"
#include "inverse/prior/base/unknowns.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/search/multi_start.hpp"
#include "inverse/target/tongue_line.hpp"
#include "server/dispatch/replies.hpp"

namespace genio {

struct RequestWorker::State {
  explicit State(const Model& m) : workspace(m), line(m) {
    const auto make_atlas_of = [](TongueState& tongue, bool bilateral) {
      tongue.atlas.get(*tongue.model, Prior{}, bilateral, tongue.workspace);
    };
    if (TongueState* half = workspace.half(Prior{})) make_atlas_of(*half, true);
    else make_atlas_of(workspace.whole(), true);
    make_atlas_of(workspace.whole(), false);
  }
  InferWorkspace workspace;
  const TongueLine line;
};

RequestWorker::RequestWorker(const Model& model) : state_(std::make_unique<State>(model)) {}
RequestWorker::~RequestWorker() = default;

namespace {

ContourFrame frame_of(const shape_request_t& r) {
  ContourFrame frame;
  frame.number = 1;
  for (int i = 0; i < r.point_count; ++i) {
    const size_t k = size_t(i);
    if (!std::isfinite(r.x_mm[k]) || !std::isfinite(r.z_mm[k]))
      throw InputError(fmt::format("point {}: x_mm and z_mm must be finite", i + 1));
    if (std::isinf(r.y_mm[k])) throw InputError(fmt::format("point {}: y_mm is infinite", i + 1));
    if (!std::isfinite(r.sigma_mm[k]) || r.sigma_mm[k] < 0)
      throw InputError(fmt::format("point {}: sigma_mm must be 0 or above", i + 1));
    if (r.kind[k] == "surface" && std::isnan(r.y_mm[k]))
      throw InputError(fmt::format("point {}: a surface point needs y_mm", i + 1));
    frame.points.push_back({1e-3 * Vec3(r.x_mm[k], r.y_mm[k], r.z_mm[k]), 1e-3 * r.sigma_mm[k],
                            r.kind[k].empty() ? "curve" : r.kind[k]});
  }
  return frame;
}

void fill_trades(const std::vector<TradeOff>& trades, command_reply_t& reply) {
  for (size_t group = 0; group < trades.size(); ++group)
    for (const Share& share : trades[group]) {
      reply.trade_group.push_back(int(group));
      reply.trade_muscle.push_back(share.name);
      reply.trade_amount_N.push_back(share.amount);
    }
  reply.trade_count = int(reply.trade_group.size());
}

void fill(const TongueLine& line, const Answer& a, command_reply_t& reply) {
  for (const auto& c : a.muscles) {
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
  reply.mirrored = a.mirrored.value_or(std::nan(""));
  reply.mixed_optima = a.mixed_optima;
  fill_trades(a.unidentified, reply);
  for (const auto& group : a.unidentified)
    reply.unidentified.push_back(fmt::format("{}", fmt::join(names(group), "+")));
  reply.group_count = int(reply.unidentified.size());
  for (const JointForce& joint : a.joint) {
    reply.either.push_back(fmt::format("{}", fmt::join(joint.names, "+")));
    reply.either_acts.push_back(joint.acts);
    reply.either_low_N.push_back(joint.low), reply.either_high_N.push_back(joint.high);
  }
  reply.either_count = int(reply.either.size());
  reply.rms_mm = 1e3 * a.rms, reply.max_mm = 1e3 * a.max, reply.chi2_per_dof = a.chi2_per_dof;
  if (a.shape.size() > 0)
    for (const Vec2& p : line.sample(a.shape, 80)) {
      reply.line_x_mm.push_back(1e3 * p[0]);
      reply.line_z_mm.push_back(1e3 * p[1]);
    }
  reply.line_count = int(reply.line_x_mm.size());
  reply.weight = a.weight;
  for (const Alternative& other : a.alternatives) {
    reply.alternative_weight.push_back(other.weight);
    reply.alternative_rms_mm.push_back(1e3 * other.rms);
    for (const auto& c : other.muscles) reply.alternative_force_N.push_back(c.best);
  }
  reply.alternative_count = int(reply.alternative_weight.size());
  reply.alternative_force_count = int(reply.alternative_force_N.size());
}

}  // namespace

RequestAnswer answer_request(const Model& model, const shape_request_t& request, double deadline_s,
                             RequestWorker& worker, const RequestHooks& hooks,
                             const StreamState& start) {
  RequestAnswer answer{reply_without_answer(request.id, "failed", ""), {}};
  command_reply_t& reply = answer.reply;
  const Stopwatch watch;
  const TongueLine& line = worker.state().line;
  try {
    const double noise =
        request.default_sigma_mm > 0 ? 1e-3 * request.default_sigma_mm : point_noise;
    const Target target = make_target(model, frame_of(request), noise);
    const Prior prior;
    InferOptions options;
    options.deadline_s = deadline_s;
    if (request.bilateral >= 0) options.bilateral = request.bilateral == 1;
    const bool bilateral = options.bilateral.value_or(target.midsagittal());
    if (start.unknowns.size() == Eigen::Index(unknowns_of(model, prior, bilateral).size()) &&
        start.prior == request.prior)
      options.start = start.unknowns, options.start_shape = start.shape;
    options.progress = hooks.progress, options.cancelled = hooks.cancelled;
    if (hooks.improved)
      options.improved = [&](const Answer& so_far) {
        command_reply_t best = reply_without_answer(request.id, "deadline", "");
        best.wall_s = watch.seconds(), best.verdict = to_string(so_far.verdict);
        fill(line, so_far, best);
        hooks.improved(std::move(best));
      };
    const Answer a = infer_from_starts(model, target, prior, worker.state().workspace, options,
                                       {request.starts});
    reply.status = to_string(a.status);
    reply.message = a.message;
    reply.verdict = to_string(a.verdict);
    reply.ipopt_iterations = a.iterations;
    reply.factorizations = a.factorizations;
    reply.wall_s = a.wall_s;
    fill(line, a, reply);
    if (a.status == InferStatus::converged) answer.state = {request.prior, a.activations, a.shape};
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    reply.message = e.what();
  }
  return answer;
}

}  // namespace genio
