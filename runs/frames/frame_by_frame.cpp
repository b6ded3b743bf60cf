#include "runs/frames/frame_by_frame.hpp"

#include <algorithm>
#include <cmath>

#include "forward/statics/equilibrium.hpp"
#include "inverse/prior/base/unknowns.hpp"
#include "inverse/sequence/chained_prior.hpp"

namespace genio {
namespace {

/// The unknowns of an earlier answer; empty where it does not tell them all.
Vector recorded_unknowns(const AnswerRecord& answer, const std::vector<Unknown>& unknowns) {
  if (!answer.converged()) return {};
  Vector z(Eigen::Index(unknowns.size()));
  for (size_t i = 0; i < unknowns.size(); ++i) {
    const std::string& name = unknowns[i].name;
    if (const auto it = answer.activation.find(name); it != answer.activation.end())
      z[Eigen::Index(i)] = it->second;
    else if (const auto other = answer.estimated.find(name); other != answer.estimated.end())
      z[Eigen::Index(i)] = unknowns[i].z_of(other->second);
    else return {};
  }
  return z;
}

/// Starts the next descent where an earlier answer ended, as if it had just been found: a start
/// without its shape would be taken for a guess.
void start_from(const AnswerRecord& answer, const Model& model,
                const std::vector<Unknown>& unknowns, InferWorkspace& ws, InferOptions& infer) {
  infer.start = recorded_unknowns(answer, unknowns);
  if (infer.start.size() == 0) return;
  const Equilibrium held =
      solve_equilibrium(model, apply_unknowns(unknowns, infer.start, default_parameters(model)),
                        model.rest, ws.whole().workspace);
  if (held) infer.start_shape = held.x;
}

}  // namespace

void answer_frames(const Model& model, const std::vector<Frame>& frames,
                   const FrameByFrame& options, const std::optional<AnswerRecord>& before,
                   InferWorkspace& ws, const TakeAnswer& take) {
  InferOptions infer = options.frame.infer;
  double last_time = std::nan("");
  for (const Frame& frame : frames) {
    Answer answer;
    if (!frame.target.empty()) {
      Prior prior = options.frame.prior;
      if (&frame == &frames.front() && before) {
        const bool bilateral = infer.bilateral.value_or(frame.target.midsagittal());
        start_from(*before, model, unknowns_of(model, prior, bilateral), ws, infer);
        last_time = before->time_s;
      }
      if (options.walks && infer.start.size() > 0)
        prior.before = Prior::Before{infer.start, walk_sd(prior, last_time, frame.contour.time_s)};
      answer = infer_from_starts(model, frame.target, prior, ws, infer, options.frame.starts);
      last_time = frame.contour.time_s;
    }
    const AnswerView view = view_of(model, frame, answer);
    if (answer.status == InferStatus::converged) start_from(answer, infer);
    take(frame.contour, view, answer.shape);
  }
}

std::optional<AnswerRecord> answer_before(const std::vector<Frame>& frames,
                                          const AnswerRecords& known) {
  if (frames.empty()) return std::nullopt;
  const auto it = known.find(frames.front().contour.number - 1);
  return it == known.end() ? std::nullopt : std::optional(it->second);
}

std::pair<size_t, size_t> run_of_neighbours(size_t items, int k, int count) {
  return {items * size_t(k) / size_t(count), items * size_t(k + 1) / size_t(count)};
}

void answer_in_processes(const Model& model, const std::vector<Frame>& frames,
                         const FrameByFrame& options, const AnswerRecords& known, int processes,
                         const MakeMessage& message, const Send& collect) {
  const int count = std::clamp(processes, 1, std::max(1, int(frames.size())));
  const auto work = [&](int k, const Send& send) {
    const auto [first, end] = run_of_neighbours(frames.size(), k, count);
    const std::vector<Frame> mine(frames.begin() + long(first), frames.begin() + long(end));
    const std::optional<AnswerRecord> before = answer_before(mine, known);
    InferWorkspace ws(model);
    answer_frames(model, mine, options, before, ws,
                  [&](const ContourFrame& frame, const AnswerView& view, const Positions& shape) {
                    send(message(frame, view, shape));
                  });
  };
  in_processes(count, work, collect);
}

}  // namespace genio
