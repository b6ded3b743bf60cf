#include "bench/figures/forward/dynamic.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/problems/block.hpp"
#include "bench/problems/clock.hpp"
#include "forward/anatomy/import_grenoble.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/half_model.hpp"
#include "forward/motion/dynamics.hpp"

namespace genio::bench {
namespace {

/// 120 ms in 2 ms steps under the commands `p`, in units of one factorisation.
Json measure(const Model& m, const Parameters& p, int repeats, Trajectory& t) {
  const Parameters rest = default_parameters(m);
  Workspace ws(m);
  std::vector<double> time;
  for (int i = 0; i < repeats; ++i) {
    Workspace fresh(m);
    time.push_back(seconds([&] { t = simulate(m, ramp(p, p, 0), m.rest, fresh, {}); }));
  }
  stiffness(m, m.rest, rest, ws.stiffness);
  ws.reduced.assign(ws.stiffness);
  const double factor = median_seconds(9, [&] { ws.cholesky.factorize(ws.reduced); }),
               wall = median(time);
  return {{"status", t ? "converged" : "failed"},
          {"message", t.message},
          {"unknowns", m.dofs.unknowns()},
          {"factor_ms", 1e3 * factor},
          {"wall_ms", 1e3 * wall},
          {"dynamic_over_factor", wall / factor},
          {"realtime_factor", wall / t.instants.back().time},
          {"steps", t.instants.size() - 1},
          {"rejected_steps", t.rejected},
          {"iterations", t.newton_iterations},
          {"factorizations", t.factorizations},
          {"max_penetration_mm", 1e3 * t.max_penetration}};
}

Json tongue(const ModelDescription& description, const std::string& name, bool half) {
  ModelDescription d = half ? half_of(description, name) : description;
  d.effects["viscosity"] = {{"alpha", 40}, {"beta", 0.03}};
  const Model m = build_model(d, name);
  Parameters p = default_parameters(m);
  set_command(m, "GGP", half ? 1 : 2, p);
  Trajectory t;
  Json j = measure(m, p, 5, t);
  j["model"] = d.name;
  const Vec3 u = 1e3 * (node_position(t.instants.back().x, m.landmarks.tip) -
                        node_position(m.rest, m.landmarks.tip));
  j["tip_mm"] = {u[0], u[1], u[2]};
  return j;
}

Json run_dynamic(const BenchOptions& o, const Progress& progress) {
  const Model m = block(1);
  Parameters p = default_parameters(m);
  p[parameter_index(m, "load.force")] = 0.2;
  progress("block of 960 elements");
  Trajectory t;
  Json j = measure(m, p, 7, t);
  const int top = top_centre(1);
  const Vec3 u = 1e3 * (node_position(t.instants.back().x, top) - node_position(m.rest, top));
  j["top_centre_mm"] = {u[0], u[1], u[2]};
  progress("CalculiX on the same block");
  j["calculix_ratio"] = nullptr;
  CalculixProblem problem = block_for_calculix(m, 0.2);
  problem.duration = 0.12, problem.step = 0.002, problem.alpha = 40, problem.beta = 0.03;
  if (const auto peer = run_calculix(problem)) {
    const Vec3 v = 1e3 * (node_position(peer->x, top) - node_position(m.rest, top));
    j["calculix_s"] = peer->cpu_s;
    j["calculix_ratio"] = 1e3 * peer->cpu_s / j["wall_ms"].get<double>();
    j["calculix_c3d8_top_centre_mm"] = {v[0], v[1], v[2]};
  }
  j["tongues"] = Json::array();
  std::vector<std::pair<std::string, ModelDescription>> tongues = {
      {o.model, read_description(o.model)}};
  if (!o.data.empty()) tongues.emplace_back(o.data, import_grenoble(o.data));
  for (const auto& [name, description] : tongues)
    for (const bool half : {false, true}) {
      progress(fmt::format("GGP 2 N with contact: {}{}", description.name, half ? ", half" : ""));
      try {
        j["tongues"].push_back(tongue(description, name, half));
      } catch (const InputError& e) {
        progress(e.what());
      }
    }
  return j;
}

}  // namespace

Benchmark dynamic_bench() {
  return {.name = "dynamic",
          .about = "120 ms of motion in steps of 2 ms over one factorisation",
          .options = {{"--data", "folder of the ANSYS files"}},
          .run = run_dynamic};
}

}  // namespace genio::bench
