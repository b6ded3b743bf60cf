#include "cli/bench.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "bench/figures/benchmarks.hpp"
#include "cli/bench_discover.hpp"
#include "cli/support.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "report/verification_report.hpp"

namespace genio::cli {
namespace {

struct BenchOptions {
  std::string what, model = default_model(), data, target, palate, out, only;
  int sample = 0, threads = 1;
  unsigned seed = 1;
  bool json = false, all = false, only_data = false;
};

const std::string& needed(const std::string& value, const char* option, const std::string& what) {
  if (value.empty()) throw InputError(fmt::format("bench {}: needs {}", what, option));
  return value;
}

int run(const BenchOptions& o) {
  const auto report = print_line;
  bench::Json j;
  if (o.what == "peer") {
    j = bench::peer(needed(o.data, "--data", o.what), report);
  } else if (o.what == "grenoble") {
    j = bench::grenoble(needed(o.data, "--data", o.what), report);
  } else if (o.what == "grenoble-gravity") {
    j = bench::grenoble_gravity(needed(o.data, "--data", o.what), report);
  } else if (o.what == "discover") {
    j = bench_discover(o.model, o.out.empty() ? "bench-discover" : o.out, o.sample, o.seed,
                       o.threads, o.only_data, o.only);
  } else if (o.what == "forward") {
    j = bench::forward(report);
  } else if (o.what == "verification") {
    j = bench::verification(o.data, report);
    if (!o.out.empty()) write_verification(j, o.out);
  } else if (o.what == "dynamic") {
    j = bench::dynamic(o.model, o.data, report);
  } else {
    const Model m = read_model(o.model);
    if (o.what == "inverse") {
      j = bench::inversion_cost(m, report);
      j.update(bench::blind(read_description(o.model), o.sample > 0 ? o.sample : 20, report));
    } else if (o.what == "reach") j = bench::reach(m, o.sample > 0 ? o.sample : 200, report);
    else if (o.what == "gesture") j = bench::gesture(m, report);
    else if (o.what == "robustness")
      j = bench::robustness(m, o.sample > 0 ? o.sample : 500, report);
    else if (o.what == "service") j = bench::service(m);
    else
      j = bench::ultrasound(m, needed(o.target, "--target", o.what),
                            needed(o.palate, "--palate", o.what), o.all, report);
  }
  fmt::print("{}\n", o.json ? j.dump() : j.dump(2));
  return done;
}

}  // namespace

Runner add_bench(Options& options) {
  auto o = std::make_shared<BenchOptions>();
  options.add(
      "what", o->what,
      "forward, dynamic, robustness, verification, inverse, reach, peer, gesture, "
      "discover, service, "
      "ultrasound, grenoble, grenoble-gravity",
      {.required = true,
       .among = {"forward", "dynamic", "robustness", "verification", "inverse", "reach", "peer",
                 "gesture", "discover", "service", "ultrasound", "grenoble", "grenoble-gravity"}});
  options.add("--model", o->model, "Model folder or model.toml");
  options.add("--data", o->data,
              "grenoble, peer, dynamic, verification: folder of the ANSYS files");
  options.add("--target", o->target, "ultrasound: contours, one label a word");
  options.add("--palate", o->palate, "ultrasound: palate trace of the same session");
  options.add("--sample", o->sample,
              "Random cases: robustness (500), reach (200), inverse (20), discover (all)",
              {.range = {{1, 100000}}});
  options.add("--threads", o->threads, "discover: data sets at a time", {.range = {{1, 1024}}});
  options.flag("--only-data", o->only_data, "discover: make the data sets, run nothing");
  options.add("--only", o->only, "discover: data sets whose names contain this");
  options.add("--seed", o->seed, "discover: which random cases a sample takes");
  options.flag("--all", o->all, "ultrasound: every frame, not one a word");
  options.add("--out", o->out,
              "verification: folder for its tables and plots; discover: for data and results");
  options.flag("--json", o->json, "One JSON object on standard output");
  options.footer("Example: genio bench inverse");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
