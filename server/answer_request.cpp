#include "server/answer_request.hpp"

#include <fmt/format.h>

#include <cmath>

#include "inverse/recording/frame_target.hpp"
#include "inverse/search/multi_start.hpp"

namespace genio {

constexpr int most_starts = 1000;

struct RequestWorker::State {
  explicit State(const Model& m) : workspace(m) {
    TongueState* half = workspace.half(Prior{});
    TongueState& tongue = half ? *half : workspace.whole();
    tongue.atlas.get(*tongue.model, Prior{}, true, tongue.workspace);
  }
  InferWorkspace workspace;
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

void fill(const Model& model, const Answer& a, command_reply_t& reply) {
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
  }
  reply.muscle_count = int(reply.muscle.size());
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
    for (const Vec2& p : TongueLine(model).sample(a.shape, 80)) {
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

command_reply_t answer_request(const Model& model, const shape_request_t& request,
                               RequestWorker& worker,
                               const std::function<void(int, double)>& progress,
                               const std::function<bool()>& cancelled) {
  command_reply_t reply{};
  reply.id = request.id;
  reply.status = "failed";
  reply.verdict = "none";
  try {
    if (!std::isfinite(request.default_sigma_mm) || request.default_sigma_mm < 0)
      throw InputError("default_sigma_mm must be 0 or above");
    if (!std::isfinite(request.deadline_s) || request.deadline_s < 0)
      throw InputError("deadline_s must be 0 or above");
    if (request.bilateral < -1 || request.bilateral > 1)
      throw InputError("bilateral must be -1, 0 or 1");
    if (request.starts < 0 || request.starts > most_starts)
      throw InputError(fmt::format("starts must be 0 to {}", most_starts));
    const double noise =
        request.default_sigma_mm > 0 ? 1e-3 * request.default_sigma_mm : point_noise;
    const Target target = make_target(model, frame_of(request), noise);
    InferOptions options;
    options.deadline_s = request.deadline_s;
    if (request.bilateral >= 0) options.bilateral = request.bilateral == 1;
    options.progress = progress;
    options.cancelled = cancelled;
    const Answer a = infer_from_starts(model, target, Prior{}, worker.state().workspace, options,
                                       {request.starts});
    reply.status = to_string(a.status);
    reply.message = a.message;
    reply.verdict = to_string(a.verdict);
    reply.ipopt_iterations = a.iterations;
    reply.factorizations = a.factorizations;
    reply.wall_s = a.wall_s;
    fill(model, a, reply);
  } catch (const std::exception& e) {
    reply.message = e.what();
  }
  return reply;
}

}  // namespace genio
