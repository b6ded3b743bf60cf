#include "bench/figures/inverse/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "bench/problems/clock.hpp"
#include "bench/problems/random_muscles.hpp"
#include "bench/truths/calibration_count.hpp"
#include "bench/truths/erring_truth.hpp"
#include "bench/truths/measured_shape.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/mirror.hpp"
#include "inverse/search/multi_start.hpp"

namespace genio::bench {
namespace {

/// How many muscles act and how strongly, as parts of their maxima.
struct Regime {
  const char* name;
  int fewest, most;
  double least, largest;
};
constexpr std::array all_regimes = {Regime{"rest", 0, 0, 0, 0}, Regime{"weak", 1, 3, 0.01, 0.08},
                                    Regime{"usual", 2, 5, 0, 0.3}, Regime{"strong", 6, 9, 0, 0.4}};
constexpr std::array device_noises = {0.3e-3, 0.5e-3};  // [m]

/// The first of the seeds from `seed` on whose tongue can be built: turned fibres may turn an
/// element inside out.
Model built(const ModelDescription& model, ModelFault fault, unsigned seed) {
  constexpr unsigned patience = 20;
  for (unsigned k = 0;; ++k) try {
      return build_model(erring_truth(model, fault, seed + k), to_string(fault));
    } catch (const InputError&) {
      if (k + 1 == patience) throw;
    }
}

/// A tongue that errs, solved on its right half where it is its own mirror image.
class ErringTongue {
 public:
  ErringTongue(const ModelDescription& model, ModelFault fault, unsigned seed)
      : whole_(built(model, fault, seed)), mirror_(mirror_of(whole_)), workspace_(solved()) {}

  const Model& whole() const { return whole_; }
  /// Empty where there is no equilibrium.
  std::optional<Positions> shape(const std::map<std::string, double>& forces) {
    Parameters p = default_parameters(solved());
    for (const auto& [name, newtons] : forces)
      set_command(solved(), name, mirror_ ? newtons / 2 : newtons, p);
    const Equilibrium e = solve_equilibrium(solved(), p, solved().rest, workspace_);
    if (!e) return {};
    return mirror_ ? Positions(mirror_->whole(e.x)) : e.x;
  }

 private:
  const Model& solved() const { return mirror_ ? mirror_->half : whole_; }

  Model whole_;
  std::unique_ptr<const Mirror> mirror_;
  Workspace workspace_;
};

/// The same draws for everything that is measured of one tongue.
struct Case {
  std::map<std::string, double> forces;  ///< by bilateral name [N]
  double noise;
  unsigned seed;  ///< of its noise
};

Case drawn(const std::vector<Unknown>& commands, const Regime& regime, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Case c;
  for (int i : some_muscles(commands.size(), random, uniform, regime.fewest, regime.most)) {
    const double part = regime.least + (regime.largest - regime.least) * uniform(random);
    c.forces[commands[size_t(i)].name] = part * commands[size_t(i)].scale;
  }
  c.noise = device_noises[size_t(uniform(random) * device_noises.size())];
  c.seed = unsigned(random());
  return c;
}

/// Counts by regime, then by what is measured, then by the truth's fault.
using Counts = std::map<std::string, std::map<std::string, CalibrationCount>>;

struct Run {
  const Model& model;
  InferWorkspace workspace;
  Counts by_measurement = {}, by_fault = {};
  CalibrationCount all = {};
  std::vector<double> wall = {};
  int without_equilibrium = 0;

  void answer(ErringTongue& truth, const Case& c, const Regime& regime, ModelFault fault) {
    const auto shape = truth.shape(c.forces);
    if (!shape) {
      ++without_equilibrium;
      return;
    }
    for (Measurement what : all_measurements) {
      std::mt19937 random(c.seed);
      const Target target = measured_shape(truth.whole(), *shape, what, c.noise, random);
      const Answer a = infer_from_starts(model, target, Prior{}, workspace);
      for (CalibrationCount* count : {&by_measurement[regime.name][to_string(what)],
                                      &by_fault[regime.name][to_string(fault)], &all})
        if (a.status == InferStatus::converged) count->add(a.muscles, c.forces, a.verdict, a.rms);
        else count->add_failure();
      wall.push_back(a.wall_s);
    }
  }
};

Json table(const Counts& counts) {
  Json json;
  for (const auto& [regime, row] : counts)
    for (const auto& [column, count] : row) json[regime][column] = count.json();
  return json;
}

Json run_calibration(const BenchOptions& o, const Progress& progress) {
  const ModelDescription description = read_description(o.model);
  const Model model = build_model(description, "model");
  const int count = o.sample > 0 ? o.sample : 100;
  const auto commands = muscle_unknowns(model, true);
  Run run{model, InferWorkspace(model)};
  for (ModelFault fault : all_faults) {
    if (progress) progress(fmt::format("truths with {}", to_string(fault)));
    ErringTongue truth(description, fault, o.seed);
    for (const Regime& regime : all_regimes) {
      if (!o.only.empty() && o.only != regime.name) continue;
      std::mt19937 random(o.seed + 1000 * unsigned(fault));
      const int here = (count + int(all_faults.size()) - 1) / int(all_faults.size());
      for (int k = 0; k < here; ++k) {
        run.answer(truth, drawn(commands, regime, random), regime, fault);
        if (progress) progress(fmt::format("{}: {} of {}", regime.name, k + 1, here));
      }
    }
  }
  return {{"seed", o.seed},
          {"by_measurement", table(run.by_measurement)},
          {"by_fault", table(run.by_fault)},
          {"all", run.all.json()},
          {"truths_without_equilibrium", run.without_equilibrium},
          {"wall_s_median", median(run.wall)}};
}

std::string share_text(const Json& share) {
  return share.is_null() ? "   -" : fmt::format("{:3.0f} %", 100 * share.get<double>());
}

std::string for_people(const Json& json) {
  std::string text =
      "                                           90 % intervals hold      P(acts) of\n"
      "regime  measured        targets  explained  active  resting  width   active  resting  "
      "error\n";
  for (const char* part : {"by_measurement", "by_fault"})
    for (const auto& [regime, row] : json[part].items())
      for (const auto& [column, c] : row.items())
        text += fmt::format("{:<7} {:<15} {:>7}  {:>9}  {:>6}  {:>7}  {}  {}   {}    {:.3f}\n",
                            regime, column, c["targets"].get<int>(), share_text(c["explained"]),
                            share_text(c["active"]), share_text(c["resting"]),
                            share_text(c["width_of_active"]), share_text(c["acts_of_active"]),
                            share_text(c["acts_of_resting"]), c["calibration_error"].get<double>());
  return text + fmt::format("calibration error of P(acts) over all: {:.3f}; {:.2f} s an answer\n",
                            json["all"]["calibration_error"].get<double>(),
                            json["wall_s_median"].get<double>());
}

}  // namespace

Benchmark calibration_bench() {
  return {.name = "calibration",
          .about = "whether intervals hold the truth, where truth differs from the model",
          .options = {{"--sample", "targets a regime (100)"},
                      {"--seed", "which are drawn"},
                      {"--only", "this regime alone: rest, weak, usual or strong"}},
          .run = run_calibration,
          .for_people = for_people};
}

}  // namespace genio::bench
