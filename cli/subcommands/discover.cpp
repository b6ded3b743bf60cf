#include "cli/subcommands/discover.hpp"

#include <fmt/format.h>

#include <memory>

#include "cli/support.hpp"
#include "discrepancy/contest/discover.hpp"
#include "forward/base/text_file.hpp"
#include "forward/model/build_model.hpp"
#include "report/discovery/discovery_page.hpp"
#include "report/discovery/discovery_pictures.hpp"
#include "report/discovery/discovery_report.hpp"
#include "report/pictures/svg.hpp"

namespace genio::cli {
namespace {

struct DiscoverCommand {
  std::string model = default_model(), observations, out;
  unsigned seed = 1;
  int refits = 5, effects = 3;
  bool json = false;
};

void print_table(const Discovery& d) {
  fmt::print("{}: {}\n", to_string(d.verdict), d.message);
  for (const NamedEffect& e : d.effects) {
    fmt::print("  {}  probability {:.3f}\n", label(e.effect, e.where), e.confidence);
    for (const SharedEstimate& p : e.parameters)
      fmt::print("    {} = {:.4g} {}  (90 %: {:.4g} to {:.4g})\n", p.name.text(), p.value, p.unit,
                 p.low, p.high);
  }
  for (const AlternativeEffect& r : d.alternatives)
    fmt::print("  or {}  probability {:.3f}, signature alike {:.2f}\n", label(r.effect, r.where),
               r.probability, r.similarity);
  fmt::print("gap {:.2f} -> {:.2f} mm; held out {:.2f} -> {:.2f} mm; noise {:.2f} mm\n",
             1e3 * d.before.rms, 1e3 * d.after.rms, 1e3 * d.heldout_before.rms,
             1e3 * d.heldout_after.rms, 1e3 * d.noise);
}

int run(const DiscoverCommand& o) {
  const ModelDescription description = read_description(o.model);
  const Observations observations =
      read_observations(o.observations, build_model(description, o.model));
  DiscoverOptions options;
  options.refits = o.refits, options.most_effects = o.effects;
  options.progress = print_line;
  const Discovery d = discover(description, observations, options);
  std::string model;
  if (!o.out.empty()) {
    make_folder(o.out);
    if (!d.effects.empty()) {
      model = o.out + "/model";
      write_description(d.model, model);
    }
    write_text(o.out + "/discovery.json", discovery_json(d, observations, model, 2) + "\n");
    const std::string maps = draw_maps(d, observations);
    write_text(o.out + "/maps.svg", maps);
    write_png(o.out + "/maps.png", maps, 1.5);
    const std::string contours = draw_contours(d, observations);
    write_text(o.out + "/contours.svg", contours);
    write_png(o.out + "/contours.png", contours, 1.5);
    write_text(o.out + "/discovery.html", discovery_page(d, observations, description.name));
  }
  if (o.json) fmt::print("{}\n", discovery_json(d, observations, model));
  else print_table(d);
  return done;
}

}  // namespace

Runner add_discover(Options& options) {
  auto o = std::make_shared<DiscoverCommand>();
  options.add("--model", o->model, "Model folder or model.toml");
  options.add("--observations", o->observations, "TOML file of conditions", {.required = true});
  options.add("--out", o->out, "Folder for the patched model and the report");
  options.add("--seed", o->seed, "Of what is drawn at random: nothing so far");
  options.add("--refits", o->refits, "Candidates refitted a round (5)", {.range = {{1, 100}}});
  options.add("--effects", o->effects, "Effects looked for, one after another (3)",
              {.range = {{1, 10}}});
  options.flag("--json", o->json, "One JSON object on standard output");
  options.footer("Example: genio discover --observations observations.toml --out found");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
