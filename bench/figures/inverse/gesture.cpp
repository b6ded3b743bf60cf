#include "bench/figures/inverse/gesture.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/problems/clock.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/sequence/motion_inversion.hpp"

namespace genio::bench {
namespace {

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
  return {{"gesture_over_simulation", median(ratios)}, {"gestures", cases}};
}

}  // namespace

Benchmark gesture_bench() {
  return {.name = "gesture",
          .about = "A gesture of 200 ms inverted with its inertia, over the time of its simulation",
          .run = run_gesture};
}

}  // namespace genio::bench
