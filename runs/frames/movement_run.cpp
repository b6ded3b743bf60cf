#include "runs/frames/movement_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr double lead = 0.1;  // of a movement before its first frame [s]

size_t nearest_knot(const MotionAnswer& a, double time_s) {
  const auto off = [&](double knot) { return std::abs(knot - time_s); };
  return size_t(std::ranges::min_element(a.knots_s, {}, off) - a.knots_s.begin());
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
  result.joint = a.joint[nearest_knot(a, f.time_s)];
  return result;
}

double first_time(const std::vector<Frame>& frames) {
  const auto it =
      std::find_if(frames.begin(), frames.end(), [](const Frame& f) { return !f.target.empty(); });
  return it == frames.end() ? 0 : it->contour.time_s;
}

}  // namespace

std::vector<Estimate> commands_at(const MotionAnswer& a, double time_s) {
  const auto after = size_t(std::lower_bound(a.knots_s.begin(), a.knots_s.end(), time_s - 1e-9) -
                            a.knots_s.begin());
  const size_t j = std::clamp<size_t>(after, 1, a.knots_s.size() - 1);
  const double s =
      std::clamp((time_s - a.knots_s[j - 1]) / (a.knots_s[j] - a.knots_s[j - 1]), 0., 1.);
  std::vector<Estimate> result = a.estimates[j];
  for (size_t c = 0; c < result.size(); ++c) {
    const Estimate& before = a.estimates[j - 1][c];
    const auto between = [&](double from, double& to) { to = (1 - s) * from + s * to; };
    between(before.best, result[c].best), between(before.sd, result[c].sd);
    between(before.median, result[c].median), between(before.mean, result[c].mean);
    between(before.low, result[c].low), between(before.high, result[c].high);
    between(before.information_bits, result[c].information_bits);
    // Between two knots a muscle pulls unless it rests at both; of a fixed force no probability is
    // told, and a start at rest is one.
    const auto acts = [](const Estimate& e) { return e.fixed ? double(e.best > 0) : e.acts; };
    if (s == 0) result[c].acts = before.acts;
    else if (s < 1 && !(before.fixed && result[c].fixed))
      result[c].acts = std::max(acts(before), acts(result[c]));
  }
  return result;
}

std::string commands_csv(const MotionAnswer& a) {
  std::string text = "time_s";
  for (const auto& c : a.estimates.front())
    text += "," + c.name + (c.kind == Unknown::Kind::muscle ? "_N" : "");
  for (size_t j = 0; j < a.knots_s.size(); ++j) {
    text += fmt::format("\n{:.6f}", a.knots_s[j]);
    for (const auto& c : a.estimates[j]) text += fmt::format(",{:.6g}", c.best);
  }
  return text + "\n";
}

MotionAnswer answer_movement(const Model& model, const std::vector<Frame>& frames,
                             const FrameOptions& options, const MovementOptions& movement,
                             const Checkpoint& checkpoint, const TakeProgress& progress,
                             const TakeAnswer& take) {
  if (std::isnan(first_time(frames)))
    throw InputError("--dynamic: frames must rise in time, and the target gives no times");
  const double start = movement.start_s.value_or(first_time(frames) - lead);
  std::vector<MotionFrame> measured;
  for (const Frame& f : frames)
    if (!f.target.empty()) measured.push_back({f.target, f.contour.time_s - start});
  MotionOptions motion;
  motion.time.step = movement.step_s;
  motion.knot_s = movement.knot_s, motion.from_rest = movement.from_rest;
  motion.infer = options.infer;
  motion.known = checkpoint.known();
  motion.checkpoint = [&](const std::vector<Vector>& z) { checkpoint.keep(z); };
  motion.progress = progress;
  InferWorkspace ws(model);
  const MotionAnswer a = infer_motion(model, measured, options.prior, ws, motion);
  progress(1, fmt::format("{} simulations, {:.1f} s", a.simulations, a.wall_s));
  size_t k = 0;
  for (const Frame& f : frames) {
    const Answer answer = f.target.empty() ? Answer() : answer_at(a, k++);
    take(f.contour, view_of(model, f, answer), answer.shape);
  }
  return a;
}

}  // namespace genio
