#include "bench/figures/inverse/gesture.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "bench/problems/clock.hpp"
#include "bench/problems/random_muscles.hpp"
#include "bench/problems/truth.hpp"
#include "bench/truths/calibration_count.hpp"
#include "bench/truths/measured_shape.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/sequence/motion_inversion.hpp"

namespace genio::bench {
namespace {

constexpr std::array instants = {0.1, 0.2};  // between which commands are linear [s]

/// Forces by bilateral name at the instants [N]: 2 to 4 muscles, up to 30 % of their maxima.
using Gesture = std::array<std::map<std::string, double>, instants.size()>;

Gesture random_gesture(const std::vector<Unknown>& commands, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Gesture gesture;
  for (int i : some_muscles(commands.size(), random, uniform, 2, 4))
    for (auto& forces : gesture)
      forces[commands[size_t(i)].name] = 0.3 * commands[size_t(i)].scale * uniform(random);
  return gesture;
}

/// From rest through the gesture.
CommandsOverTime over_time(const Model& m, const Gesture& gesture) {
  CommandsOverTime c{{0}, {default_parameters(m)}};
  for (size_t k = 0; k < instants.size(); ++k) {
    c.times.push_back(instants[k]), c.values.push_back(default_parameters(m));
    for (const auto& [name, newtons] : gesture[k]) set_command(m, name, newtons, c.values.back());
  }
  return c;
}

/// Whether the intervals at the knots hold, where movements are those of a tongue that differs from
/// the model in its fibres, 5 degrees on average, and measured to 0.4 mm.
Json intervals_of_movements(const BenchOptions& o, const Model& m, InferWorkspace& worker,
                            const Progress& progress) {
  constexpr double sigma = 0.4e-3;
  const Model whole = build_model(with_turned_fibres(read_description(o.model), 5, o.seed), "truth");
  const auto commands = muscle_unknowns(m, true);
  Workspace ws(whole);
  std::mt19937 random(o.seed);
  CalibrationCount count;
  for (int k = 0; k < o.sample; ++k) {
    const Gesture gesture = random_gesture(commands, random);
    MotionOptions options;
    options.from_rest = true, options.knot_s = instants[1] - instants[0];
    TimeOptions time = options.time;
    time.duration = instants.back();
    const Trajectory t = simulate(whole, over_time(whole, gesture), whole.rest, ws, time);
    if (!t) continue;
    std::vector<MotionFrame> frames;
    for (double when : {0.05, 0.1, 0.15, 0.2})
      frames.push_back(
          {measured_shape(whole, shape_at(t, when), Measurement::curve, sigma, random), when});
    const MotionAnswer a = infer_motion(m, frames, Prior{}, worker, options);
    for (size_t i = 0; i < instants.size(); ++i)
      if (a.status == InferStatus::converged)
        count.add(a.estimates[i + 1], gesture[i], a.verdict, a.rms);
      else count.add_failure();
    if (progress) progress(fmt::format("movement {} of {}", k + 1, o.sample));
  }
  return count.json();
}

Json run_gesture(const BenchOptions& o, const Progress& progress) {
  const Model m = read_model(o.model);
  using Forces = std::vector<std::pair<const char*, double>>;
  const std::vector<std::pair<Forces, Forces>> gestures = {
      {{{"GGP", 4}, {"SL", 1}}, {{"HG", 4}, {"GGA", 2}}},
      {{{"STY", 2}, {"GGM", 1}}, {{"GGP", 3}, {"TRANS", 2}}}};
  InferWorkspace worker(m);
  if (TongueState* half = worker.half(Prior{}))
    half->atlas.get(*half->model, Prior{}, true, half->workspace);
  std::vector<double> ratios;
  Json cases = Json::array();
  for (const auto& [first, second] : gestures) {
    CommandsOverTime c;
    c.times = {0, 0.1, 0.2};
    c.values.assign(3, default_parameters(m));
    for (const auto& [name, f] : first) set_command(m, name, f, c.values[1]);
    for (const auto& [name, f] : second) set_command(m, name, f, c.values[2]);
    MotionOptions options;
    options.from_rest = true;
    TimeOptions time = options.time;
    time.duration = 0.2;
    Workspace ws(m);
    const Equilibrium rest = solve_equilibrium(m, c.values[0], m.rest, ws);
    Trajectory t;
    const double forward = seconds([&] { t = simulate(m, c, rest.x, ws, time); });
    if (!t) throw std::runtime_error("the bench gesture cannot be simulated: " + t.message);
    std::vector<MotionFrame> frames;
    for (double when : {0.1, 0.2})
      frames.push_back({curve_target(m, shape_at(t, when), 40, 0.5e-3), when});
    MotionAnswer a;
    const double inverse = seconds([&] { a = infer_motion(m, frames, Prior{}, worker, options); });
    ratios.push_back(inverse / forward);
    cases.push_back({{"status", to_string(a.status)},
                     {"verdict", to_string(a.verdict)},
                     {"rms_mm", 1e3 * a.rms},
                     {"simulations", a.simulations},
                     {"ipopt_iterations", a.iterations},
                     {"forward_s", forward},
                     {"inverse_s", inverse}});
    if (progress)
      progress(fmt::format("{}: RMS {:.3f} mm, {:.2f} s, {:.1f} simulations of the whole tongue",
                           to_string(a.status), 1e3 * a.rms, inverse, inverse / forward));
  }
  Json json = {{"gesture_over_simulation", median(ratios)}, {"gestures", cases}};
  if (o.sample > 0) json["movements"] = intervals_of_movements(o, m, worker, progress);
  return json;
}

}  // namespace

Benchmark gesture_bench() {
  return {.name = "gesture",
          .about = "A gesture of 200 ms inverted with its inertia, over the time of its simulation",
          .options = {{"--sample", "random movements with noise, whose intervals are counted (0)"},
                      {"--seed", "which are drawn"}},
          .run = run_gesture};
}

}  // namespace genio::bench
