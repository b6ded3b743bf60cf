#include "bench/figures/inverse/peer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "forward/anatomy/import_grenoble.hpp"
#include "forward/model/build_model.hpp"
#include "inverse/search/multi_start.hpp"

namespace genio::bench {
namespace {

constexpr double peer_rms = 3.38;  // [mm], of the stored run where the tip is farthest forward
constexpr double forward = 10e-3;  // [m]
constexpr int tip[] = {338, 339, 340, 341, 919, 359, 926, 361, 751, 752, 753, 754, 772, 774};
constexpr int sides[] = {166, 301, 299, 141, 579, 554, 712, 714};  // that stay where they are

Json solved(const Model& m, int starts) {
  Target target;
  const auto add = [&](int node, double moved) {
    target.flesh.push_back({{{node, 1.0}},
                            node_position(m.rest, node) - moved * Vec3::UnitX(),
                            0.2e-3,
                            fmt::format("node:{}", node)});
  };
  for (int node : tip) add(node, forward);
  for (int node : sides) add(node, 0);
  Prior prior;
  prior.effort_sd = 1;  // the maxima are what limits, not effort
  InferOptions infer;
  infer.bilateral = true;
  InferWorkspace ws(m);
  const Answer a = infer_from_starts(m, target, prior, ws, infer, {starts});
  Json j = {{"status", to_string(a.status)},
            {"verdict", to_string(a.verdict)},
            {"message", a.message},
            {"rms_mm", 1e3 * a.rms},
            {"max_mm", 1e3 * a.max},
            {"starts", starts},
            {"wall_s", a.wall_s},
            {"other_optima_rms_mm", Json::array()}};
  for (const auto& other : a.alternatives) j["other_optima_rms_mm"].push_back(1e3 * other.rms);
  for (const auto& c : a.muscles) {
    j["activation"][c.name] = c.best / c.maximum;
    if (c.multiplier > 0) j["bound_multipliers"][c.name] = c.multiplier;
  }
  return j;
}

struct PeerCase {
  const char* name;
  bool contact;
  double strength;  ///< of all muscles, over the model's
};

// The last tells whether strength is what lacks.
constexpr PeerCase cases[] = {{"with_contact", true, 1},
                              {"without_contact", false, 1},
                              {"without_contact_four_times_the_maxima", false, 4}};

Json run_peer(const BenchOptions& o, const Progress& progress) {
  Json result = {{"peer_rms_mm", peer_rms}};
  for (const auto& [name, contact, strength] : cases) {
    ModelDescription d = import_grenoble(o.data);
    if (!contact) d.effects.erase("palate_contact"), d.effects.erase("jaw_contact");
    for (auto& muscle : d.muscles) muscle.max_force *= strength;
    result[name] = solved(build_model(d, "Grenoble"), 6);
    if (progress)
      progress(fmt::format("{}: RMS {:.2f} mm (peer {:.2f}), {}", name,
                           result[name]["rms_mm"].get<double>(), peer_rms,
                           result[name]["verdict"].get<std::string>()));
  }
  return result;
}

}  // namespace

Benchmark peer_bench() {
  return {.name = "peer",
          .about = "A stored run of the peer's inverse controller, repeated",
          .options = {{"--data", "folder of the ANSYS files", true}},
          .run = run_peer};
}

}  // namespace genio::bench
