#include "bench/figures/inverse/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "bench/problems/clock.hpp"
#include "bench/problems/random_muscles.hpp"
#include "bench/truths/beyond_reach.hpp"
#include "bench/truths/calibration_count.hpp"
#include "bench/truths/erring_truth.hpp"
#include "bench/truths/measured_shape.hpp"
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

/// The same draws for everything that is measured of one tongue.
struct Case {
  std::map<std::string, double> forces;  ///< by bilateral name [N]
  double noise;
  unsigned seed;  ///< of its noise, and which of its measurements leave the reach
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

/// Shapes that the model cannot make, and how many of them were explained.
struct BeyondCount {
  int shapes = 0, explained = 0;
  void add(const Answer& a) { ++shapes, explained += a.verdict == Verdict::explained; }
};
Json json_of(const BeyondCount& c) {
  return {{"shapes", c.shapes},
          {"explained", c.shapes ? Json(double(c.explained) / c.shapes) : Json()}};
}

/// Where prior and truth differ: times the width that is the default.
constexpr std::array prior_widths = {0.5, 2.0};

class Run {
 public:
  Run(const ModelDescription& description, bool with_other_priors)
      : description_(description),
        model_(build_model(description, "model")),
        workspace_(model_),
        with_other_priors_(with_other_priors) {}

  const Model& model() const { return model_; }

  void answer(ErringTongue& truth, const Case& c, const Regime& regime, ModelFault fault) {
    const auto shape = truth.shape(c.forces);
    if (!shape) {
      ++without_equilibrium_;
      return;
    }
    for (Measurement what : all_measurements) {
      std::mt19937 random(c.seed);
      const Target target = measured_shape(truth.whole(), *shape, what, c.noise, random);
      const Answer a = asked(target);
      for (CalibrationCount* count :
           {&by_measurement_[regime.name][to_string(what)],
            &by_fault_[regime.name][to_string(fault)], &by_regime_[regime.name], &all_})
        add(a, c, *count);
      if (with_other_priors_)
        for (double width : prior_widths)
          add(asked(target, with_effort(Prior{}, width)), c,
              by_prior_[regime.name][fmt::format("prior x {}", width)]);
      if (a.status == InferStatus::converged && regime.most > 0 &&
          what == all_measurements[c.seed % all_measurements.size()])
        beyond(pushed(target, a, pushed_by, random), regime, what, Beyond::pushed_surface);
    }
  }

  /// The same forces on a tongue that the model is not, where its shape is out of reach.
  void answer_beyond(const Case& c, const Regime& regime, ModelFault fault, Beyond kind) {
    std::mt19937 random(c.seed);
    std::unique_ptr<ErringTongue> other;
    try {
      other = erring_tongue(beyond_tongue(description_, kind, random), fault, c.seed);
    } catch (const InputError&) {
      // It turned inside out as it was stretched.
    }
    const auto shape = other ? other->shape(c.forces) : std::nullopt;
    if (!shape) {
      ++without_equilibrium_;
      return;
    }
    const Measurement what = all_measurements[(c.seed + 1) % all_measurements.size()];
    beyond(measured_shape(other->whole(), *shape, what, c.noise, random), regime, what, kind);
  }

  Json json() const {
    Json regimes = Json::object(), beyond = Json::object();
    for (const auto& [regime, count] : by_regime_) {
      const Json j = count.json();
      regimes[regime] = {
          {"coverage90_active", j["active"]},
          {"coverage90_resting", j["resting"]},
          {"by_group", {{"active", j["active_by_group"]}, {"resting", j["resting_by_group"]}}},
          {"by_muscle", j["active_by_muscle"]},
          {"calibration_error", j["calibration_error"]},
          {"acts_of_resting", j["acts_of_resting"]},
          {"explained", j["explained"]}};
    }
    for (const auto& [regime, row] : beyond_)
      for (const auto& [column, count] : row) beyond[regime][column] = json_of(count);
    const Json everything = all_.json();
    return {{"regimes", regimes},
            {"calibration_error", everything["calibration_error"]},
            {"reachable_explained", everything["explained"]},
            {"unreachable_explained", json_of(all_beyond_)["explained"]},
            {"by_measurement", table(by_measurement_)},
            {"by_fault", table(by_fault_)},
            {"by_prior", table(by_prior_)},
            {"beyond", beyond},
            {"within_reach_after_all", within_},
            {"beyond_failed", beyond_failed_},
            {"all", everything},
            {"truths_without_equilibrium", without_equilibrium_},
            {"wall_s_median", median(wall_)}};
  }

 private:
  static constexpr double out_of_reach = 3, pushed_by = 3.5;  // noises, root mean square

  Answer asked(const Target& target, const Prior& prior = {}) {
    Answer a = infer_from_starts(model_, target, prior, workspace_);
    wall_.push_back(a.wall_s);
    return a;
  }
  static void add(const Answer& a, const Case& c, CalibrationCount& count) {
    if (a.status == InferStatus::converged) count.add(a.muscles, c.forces, a.verdict, a.rms);
    else count.add_failure();
  }
  void beyond(const Target& target, const Regime& regime, Measurement what, Beyond kind) {
    const Answer a = asked(target);
    if (a.status != InferStatus::converged) {
      ++beyond_failed_;
      return;
    }
    if (noises_off(a) < out_of_reach) {
      ++within_;
      return;
    }
    auto& row = beyond_[regime.name];
    for (BeyondCount* count : {&row[to_string(what)], &row[to_string(kind)], &all_beyond_})
      count->add(a);
  }
  static Json table(const Counts& counts) {
    Json json = Json::object();
    for (const auto& [regime, row] : counts)
      for (const auto& [column, count] : row) json[regime][column] = count.json();
    return json;
  }

  const ModelDescription& description_;
  Model model_;
  InferWorkspace workspace_;
  bool with_other_priors_;
  Counts by_measurement_, by_fault_, by_prior_;
  std::map<std::string, CalibrationCount> by_regime_;
  /// By regime, then by what was measured and by the kind.
  std::map<std::string, std::map<std::string, BeyondCount>> beyond_;
  BeyondCount all_beyond_;
  CalibrationCount all_;
  std::vector<double> wall_;
  int without_equilibrium_ = 0, within_ = 0, beyond_failed_ = 0;
};

Json run_calibration(const BenchOptions& o, const Progress& progress) {
  const ModelDescription description = read_description(o.model);
  Run run(description, o.all);
  const int count = o.sample > 0 ? o.sample : 100;
  const auto commands = muscle_unknowns(run.model(), true);
  for (ModelFault fault : all_faults) {
    if (progress) progress(fmt::format("truths with {}", to_string(fault)));
    const auto truth = erring_tongue(description, fault, o.seed);
    for (const Regime& regime : all_regimes) {
      if (!o.only.empty() && o.only != regime.name) continue;
      std::mt19937 random(o.seed + 1000 * unsigned(fault));
      const int here = (count + int(all_faults.size()) - 1) / int(all_faults.size());
      for (int k = 0; k < here; ++k) {
        const Case c = drawn(commands, regime, random);
        run.answer(*truth, c, regime, fault);
        if (regime.most > 0)
          run.answer_beyond(c, regime, fault, k % 2 ? Beyond::other_anatomy : Beyond::open_jaw);
        if (progress) progress(fmt::format("{}: {} of {}", regime.name, k + 1, here));
      }
    }
  }
  Json json = run.json();
  json["seed"] = o.seed;
  return json;
}

std::string share_text(const Json& share) {
  return share.is_null() ? "   -" : fmt::format("{:3.0f} %", 100 * share.get<double>());
}

std::string for_people(const Json& json) {
  std::string text =
      "                                           90 % intervals hold      P(acts) of\n"
      "regime  measured        targets  explained  active  resting  width   active  resting  "
      "error\n";
  for (const char* part : {"by_measurement", "by_fault", "by_prior"})
    for (const auto& [regime, row] : json[part].items())
      for (const auto& [column, c] : row.items())
        text += fmt::format("{:<7} {:<15} {:>7}  {:>9}  {:>6}  {:>7}  {}  {}   {}    {:.3f}\n",
                            regime, column, c["targets"].get<int>(), share_text(c["explained"]),
                            share_text(c["active"]), share_text(c["resting"]),
                            share_text(c["width_of_active"]), share_text(c["acts_of_active"]),
                            share_text(c["acts_of_resting"]), c["calibration_error"].get<double>());
  text += "\nout of reach    kind or measured  shapes  explained\n";
  for (const auto& [regime, row] : json["beyond"].items())
    for (const auto& [column, c] : row.items())
      text += fmt::format("{:<15} {:<16}  {:>6}  {:>9}\n", regime, column, c["shapes"].get<int>(),
                          share_text(c["explained"]));
  return text + fmt::format(
                    "all: explained {} of those within reach, {} of those out of it; calibration "
                    "error of P(acts) {:.3f}; {:.2f} s an answer\n",
                    share_text(json["reachable_explained"]),
                    share_text(json["unreachable_explained"]),
                    json["calibration_error"].get<double>(), json["wall_s_median"].get<double>());
}

}  // namespace

Benchmark calibration_bench() {
  return {.name = "calibration",
          .about = "whether intervals hold the truth, where truth differs from the model",
          .options = {{"--sample", "targets a regime (100)"},
                      {"--seed", "which are drawn"},
                      {"--only", "this regime alone: rest, weak, usual or strong"},
                      {"--all", "also with priors of half and of twice the width"}},
          .run = run_calibration,
          .for_people = for_people};
}

}  // namespace genio::bench
