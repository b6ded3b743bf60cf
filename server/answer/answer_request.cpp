#include "server/answer/answer_request.hpp"

#include <algorithm>
#include <new>

#include "forward/base/elapsed.hpp"
#include "inverse/prior/base/unknowns.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/search/multi_start.hpp"
#include "server/answer/fill_reply.hpp"
#include "server/answer/request_placement.hpp"
#include "server/answer/request_points.hpp"
#include "server/answer/request_prior.hpp"
#include "server/dispatch/replies.hpp"

namespace genio {

namespace {

/// Thrown out of a search whose result nobody waits for. It is none of the errors that a search
/// handles by itself.
struct SearchEnded {
  InferStatus status;
};

}  // namespace

struct RequestWorker::State {
  explicit State(const Model& m) : workspace(m), line(m) {
    TongueState* half = workspace.half(Prior{});
    TongueState& tongue = half ? *half : workspace.whole();
    tongue.atlas.get(*tongue.model, Prior{}, true, tongue.workspace);
  }
  InferWorkspace workspace;
  const TongueLine line;
  std::optional<TongueReach> reach;  // made where points are first registered
};

RequestWorker::RequestWorker(const Model& model) : state_(std::make_unique<State>(model)) {}
RequestWorker::~RequestWorker() = default;

void RequestWorker::prepare(const std::function<bool()>& stop) {
  TongueState& tongue = state_->workspace.whole();
  try {
    if (!state_->reach)
      state_->reach = reach_of(*tongue.model, [&] {
        if (stop()) throw SearchEnded{InferStatus::cancelled};
      });
  } catch (const SearchEnded&) {
    return;
  }
  tongue.atlas.get(*tongue.model, Prior{}, false, tongue.workspace, stop);
}

namespace {

/// `on_step` as of TongueReach.
LaidPoints laid_by(RequestWorker::State& state, const Model& model, const shape_request_t& request,
                   const std::function<void()>& on_step) {
  return laid_points(model, request, [&] {
    if (!state.reach) state.reach = reach_of(model, on_step);
    TongueReach reach = *state.reach;
    reach.on_step = on_step;
    return reach;
  });
}

Target target_of(const Model& model, const ContourFrame& frame, double noise) {
  Target target = make_target(model, frame, noise);
  if (target.empty())
    throw InputError(frame.note.empty() ? "the target has no points" : frame.note);
  return target;
}

/// What recordings in a device's frame have beside others: the head's place is estimated along, and
/// the model is another speaker's.
void allow_for(const RequestPlacement& placement, Prior& prior, InferOptions& options) {
  if (!prior.head_pose && placement.place.head.shift_sd > 0) prior.head_pose = placement.place.head;
  options.model_error = ModelError().of_another_speaker();
}

const char* words_of(InferStatus ended) {
  return ended == InferStatus::deadline ? "the deadline passed before the first step was done"
                                        : "cancelled by the requester";
}

}  // namespace

RequestAnswer answer_request(const Model& model, const shape_request_t& request, double deadline_s,
                             RequestWorker& worker, const RequestHooks& hooks,
                             const StreamState& start) {
  RequestAnswer answer{reply_without_answer(request.id, "failed", ""), {}};
  command_reply_t& reply = answer.reply;
  const Stopwatch watch;
  RequestWorker::State& state = worker.state();
  // To register points takes long, too.
  const auto check_wanted = [&] {
    if (hooks.cancelled && hooks.cancelled()) throw SearchEnded{InferStatus::cancelled};
    if (deadline_s > 0 && watch.seconds() > deadline_s) throw SearchEnded{InferStatus::deadline};
  };
  try {
    Prior prior = prior_of(model, request);
    const LaidPoints laid = laid_by(state, model, request, check_wanted);
    fill_placement(laid.placement, reply);
    InferOptions options;
    if (laid.placement) {
      const RegistrationRecord& record = laid.placement->record;
      if (!record.judgement.faults.empty() && !record.forced)
        throw InputError("the points cannot be laid beside the model: " +
                         faults_text(record.judgement));
      allow_for(*laid.placement, prior, options);
    }
    const Target target = target_of(model, laid.frame, noise_of(request));
    if (request.bilateral >= 0) options.bilateral = request.bilateral == 1;
    const bool bilateral = options.bilateral.value_or(target.midsagittal());
    if (start.unknowns.size() == Eigen::Index(unknowns_of(model, prior, bilateral).size()) &&
        start.prior == request.prior)
      options.start = start.unknowns, options.start_shape = start.shape;
    options.progress = hooks.progress, options.cancelled = hooks.cancelled;
    if (hooks.improved)
      options.improved = [&](const Answer& so_far) {
        command_reply_t best = reply_without_answer(request.id, "deadline", "");
        best.wall_s = watch.seconds();
        fill_answer(state.line, so_far, best);
        fill_placement(laid.placement, best);
        withhold_doubtful_verdict(laid.placement, best);
        hooks.improved(std::move(best));
      };
    check_wanted();
    if (deadline_s > 0) options.deadline_s = std::max(1e-6, deadline_s - watch.seconds());
    const Answer a =
        infer_from_starts(model, target, prior, state.workspace, options, {request.starts});
    reply.status = to_string(a.status);
    reply.message = a.message;
    reply.ipopt_iterations = a.iterations;
    reply.factorizations = a.factorizations;
    fill_answer(state.line, a, reply);
    withhold_doubtful_verdict(laid.placement, reply);
    if (a.status == InferStatus::converged) answer.state = {request.prior, a.activations, a.shape};
  } catch (const SearchEnded& ended) {
    reply.status = to_string(ended.status), reply.message = words_of(ended.status);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    reply.message = reason_text(e.what());
  }
  reply.wall_s = watch.seconds();
  return answer;
}

}  // namespace genio
