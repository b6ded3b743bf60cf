#include "cli/together.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "cli/checkpoint.hpp"
#include "inverse/sequence/motion_inversion.hpp"
#include "inverse/sequence/sequence.hpp"
#include "report/motion_report.hpp"
#include "report/svg.hpp"

namespace genio::cli {
namespace {

constexpr double lead = 0.1;  // of a movement before its first frame [s]

/// One line of progress, in place on a terminal.
void progress(double part, const std::string& what) {
  const bool terminal = isatty(STDERR_FILENO);
  fmt::print(stderr, "{}{:3.0f} % {}{}", terminal ? "\r" : "", 100 * part, what,
             terminal && part < 1 ? "          " : "\n");
  std::fflush(stderr);
}

void send_frame(const Model& model, const Frame& frame, const Answer& answer,
                const OfflineOptions& o, const Send& send) {
  const AnswerView view = frame.target.empty()
                              ? unanswered(frame.contour)
                              : view_of(model, frame.target, answer, frame_title(frame.contour));
  send_answer(model, frame.contour, view, answer.shape, o.out, send);
}

/// The commands at a time between knots, spread and intervals linear too.
std::vector<Estimate> commands_at(const MotionAnswer& a, double time) {
  const auto after =
      size_t(std::lower_bound(a.knots_s.begin(), a.knots_s.end(), time - 1e-9) - a.knots_s.begin());
  const size_t j = std::clamp<size_t>(after, 1, a.knots_s.size() - 1);
  const double s =
      std::clamp((time - a.knots_s[j - 1]) / (a.knots_s[j] - a.knots_s[j - 1]), 0., 1.);
  std::vector<Estimate> result = a.estimates[j];
  for (size_t c = 0; c < result.size(); ++c) {
    const Estimate& before = a.estimates[j - 1][c];
    const auto between = [&](double from, double& to) { to = (1 - s) * from + s * to; };
    between(before.best, result[c].best), between(before.sd, result[c].sd);
    between(before.low, result[c].low), between(before.high, result[c].high);
    between(before.information_bits, result[c].information_bits);
  }
  return result;
}

Answer answer_at(const MotionAnswer& a, size_t frame) {
  Answer result;
  result.status = a.status, result.verdict = a.verdict, result.message = a.message;
  result.iterations = a.iterations, result.factorizations = a.factorizations;
  result.wall_s = a.wall_s / std::max<double>(1, double(a.frames.size()));
  if (a.status != InferStatus::converged) return result;
  const auto& f = a.frames[frame];
  result.shape = f.shape, result.residuals = f.residuals;
  result.rms = f.residuals.rms, result.max = f.residuals.max;
  result.chi2_per_dof = a.chi2_per_dof;
  for (Estimate& e : commands_at(a, f.time_s))
    (e.kind == Unknown::Kind::muscle ? result.muscles : result.others).push_back(std::move(e));
  return result;
}

std::string commands_csv(const MotionAnswer& a) {
  std::string text = "time_s";
  for (const auto& c : a.estimates.front()) text += "," + c.name + (c.unit == "N" ? "_N" : "");
  for (size_t j = 0; j < a.knots_s.size(); ++j) {
    text += fmt::format("\n{:.6f}", a.knots_s[j]);
    for (const auto& c : a.estimates[j]) text += fmt::format(",{:.6g}", c.best);
  }
  return text + "\n";
}

void move(const Model& model, const std::vector<Frame>& frames, const OfflineOptions& o,
          const TogetherOptions& how, const Send& send) {
  double first = 0;
  for (const Frame& f : frames)
    if (!f.target.empty()) {
      first = f.contour.time_s;
      break;
    }
  const double start = how.start_s.value_or(first - lead);
  std::vector<MotionFrame> measured;
  for (const Frame& f : frames)
    if (!f.target.empty()) measured.push_back({f.target, f.contour.time_s - start});
  MotionOptions options;
  options.time.step = how.step_s, options.knot_s = how.knot_s, options.from_rest = how.from_rest;
  options.infer = o.infer;
  options.progress = progress;
  Checkpoint checkpoint(o.out, how.resume);
  options.known = checkpoint.known();
  options.checkpoint = [&](const std::vector<Vector>& z) { checkpoint.keep(z); };
  InferWorkspace ws(model);
  const MotionAnswer a = infer_motion(model, measured, o.prior, ws, options);
  progress(1, fmt::format("{} simulations, {:.1f} s", a.simulations, a.wall_s));
  size_t k = 0;
  for (const Frame& f : frames)
    send_frame(model, f, f.target.empty() ? Answer() : answer_at(a, k++), o, send);
  if (o.out.empty() || a.status != InferStatus::converged) return;
  write_text(o.out + "/commands.csv", commands_csv(a));
  std::filesystem::create_directories(o.out + "/motion");
  write_motion(model, a.trajectory, o.out + "/motion");
}

}  // namespace

void answer_together(const Model& model, const std::vector<Frame>& frames, const OfflineOptions& o,
                     const TogetherOptions& how, const Send& send) {
  if (how.dynamic) return move(model, frames, o, how, send);
  std::vector<SequenceFrame> sequence;
  for (const Frame& f : frames) sequence.push_back({f.target, f.contour.time_s});
  SequenceOptions options{o.infer, o.starts, how.threads, {}, {}, progress};
  Checkpoint checkpoint(o.out, how.resume);
  options.known = checkpoint.known();
  options.checkpoint = [&](const std::vector<Vector>& z) { checkpoint.keep(z); };
  InferWorkspace ws(model);
  const auto answers = infer_sequence(model, sequence, o.prior, ws, options);
  for (size_t k = 0; k < frames.size(); ++k) send_frame(model, frames[k], answers[k], o, send);
}

}  // namespace genio::cli
