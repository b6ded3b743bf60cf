#include "cli/indentation/indent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/indentation/fit_json.hpp"
#include "cli/support.hpp"
#include "forward/base/text_file.hpp"
#include "forward/base/thin.hpp"
#include "forward/model/build_model.hpp"
#include "report/pictures/plot.hpp"
#include "report/pictures/svg.hpp"
#include "speaker/indentation/simulated_data.hpp"
#include "speaker/indentation/tissue_fit.hpp"

namespace genio::cli {
namespace {

struct IndentCommand {
  std::string data, out, model = default_model(), into, indenter;
  int layers = 1;
  ExperimentNotes notes;
  std::optional<double> deepest_mm;
  bool fit_mucosa = false, relative_scatter = false, simulate = false, json = false, quiet = false;
  // Of a simulated measurement:
  double a10 = 192, a20 = 90, depth_mm = 5, scatter = 0.05;
  int rows = 100, seed = 1;
};

/// The command line's notes as a file has them, so that the file alone is enough.
std::string notes_text(const IndentationExperiment& e, const YeohConstants& mucosa) {
  std::string text = fmt::format(
      "# indenter = {}\n# radius_mm = {:g}\n# thickness_mm = {:g}\n# half_width_mm = {:g}\n"
      "# poisson_ratio = {:g}\n",
      to_string(e.indenter), 1e3 * e.radius, 1e3 * e.thickness, 1e3 * e.half_width,
      e.poisson_ratio);
  if (e.mucosa > 0)
    text += fmt::format("# mucosa_mm = {:g}\n# mucosa_a10_Pa = {:g}\n# mucosa_a20_Pa = {:g}\n",
                        1e3 * e.mucosa, mucosa.a10, mucosa.a20);
  return text;
}

int simulate(const IndentCommand& o) {
  if (!(o.a20 >= 0 && o.scatter >= 0 && o.scatter < 1))
    throw InputError("--a20-Pa, --scatter: expected 0 or more, and less than 1 of the scatter");
  const IndentationExperiment e = experiment_of(o.notes, o.layers == 2);
  const BlockTissue tissue{{o.a10, o.a20}, mucosa_of(o.notes)};
  const ForceData d =
      simulated_data(e, tissue, 1e-3 * o.depth_mm, o.rows, o.scatter, unsigned(o.seed));
  std::string text =
      notes_text(e, tissue.mucosa) + (d.sd ? "depth_mm,force_N,sd\n" : "depth_mm,force_N\n");
  for (Eigen::Index i = 0; i < d.depth.size(); ++i) {
    text += fmt::format("{:.4f},{:.6f}", 1e3 * d.depth[i], d.force[i]);
    text += d.sd ? fmt::format(",{:.7f}\n", (*d.sd)[i]) : "\n";
  }
  make_folder(o.out);
  write_text(o.out + "/data.csv", text);
  if (!o.quiet) print_line(fmt::format("{}/data.csv: {} simulated forces", o.out, d.depth.size()));
  return done;
}

/// Without the rows that are deeper than asked for.
ForceData up_to(const ForceData& all, double deepest) {
  const Eigen::Index n = (all.depth.array() <= deepest + 1e-12).count();
  ForceData d{all.depth.head(n), all.force.head(n), {}};
  if (all.sd) d.sd = all.sd->head(n);
  return d;
}

std::string curve_csv(const ForceData& d, const TissueFit& fit) {
  std::string text = "depth_mm,force_N,predicted_N,residual_N\n";
  for (Eigen::Index i = 0; i < d.depth.size(); ++i)
    text += fmt::format("{:.6g},{:.6g},{:.6g},{:.4g}\n", 1e3 * d.depth[i], d.force[i],
                        fit.predicted[i], d.force[i] - fit.predicted[i]);
  return text;
}

/// The model with the muscle's constants, and with a mucosa of this thickness [m] where the block
/// had one. The bulk modulus keeps its ratio to a10.
void write_into(const IndentCommand& o, ModelDescription d, const TissueFit& fit,
                double thickness) {
  EffectTable& table = d.effects["elasticity"];
  const auto bulk = table.find("kappa"), before = table.find("a10");
  const double ratio = bulk != table.end() && before != table.end() && before->second > 0
                           ? bulk->second / before->second
                           : 1000;
  table["a10"] = fit.tissue.muscle.a10, table["a20"] = fit.tissue.muscle.a20;
  table["kappa"] = ratio * fit.tissue.muscle.a10;
  // The tissue of the tongue reaches up to its surface: the layer is what the mucosa is stiffer.
  const YeohConstants &mucosa = fit.tissue.mucosa, &muscle = fit.tissue.muscle;
  if (thickness > 0 && mucosa.a10 > muscle.a10)
    d.effects["mucosa_layer"] = {{"thickness", thickness},
                                 {"a10", mucosa.a10 - muscle.a10},
                                 {"a20", std::max(0.0, mucosa.a20 - muscle.a20)}};
  d.provenance += fmt::format("{}tissue constants by genio indent from {}",
                              d.provenance.empty() ? "" : "; ", o.data);
  build_model(d, o.into);  // refuses what could not be computed with
  write_description(d, o.into);
}

/// The measured and the fitted curve.
void draw_fit(const ForceData& data, const TissueFit& fit, const std::string& folder) {
  std::vector<Series> series{{"measured", {}}, {"fitted", {}}};
  for (Eigen::Index k = 0; k < data.depth.size(); ++k) {
    series[0].points.emplace_back(1e3 * data.depth[k], data.force[k]);
    series[1].points.emplace_back(1e3 * data.depth[k], fit.predicted[k]);
  }
  series[1].points = thin(series[1].points, 25);  // a smooth curve, which would hide the measured
  std::vector<std::string> notes;
  for (const FittedConstant& c : fit.constants)
    notes.push_back(
        fmt::format("{} {:.1f} Pa, 90 % within {:.1f} to {:.1f}", c.name, c.value, c.low, c.high));
  const std::string svg =
      plot("Force of the indenter", "depth [mm]", "force [N]", series, false, false, notes);
  write_text(folder + "/curve.svg", svg);
  write_png(folder + "/curve.png", svg, 1.5);
}

void print_fit(const IndentationExperiment& e, const TissueFit& fit) {
  for (const FittedConstant& c : fit.constants)
    fmt::print("{:<11} {:8.1f} Pa, sd {:.1f}, 90 % within {:.1f} to {:.1f}{}\n", c.name, c.value,
               c.sd, c.low, c.high, c.at_bound ? ", at its bound" : "");
  fmt::print("Young's modulus at rest {:.3f} kPa, sd {:.3f}\n", 1e-3 * fit.young_modulus,
             6e-3 * fit.constants.front().sd);
  if (e.mucosa > 0 && fit.constants.size() < 3)
    fmt::print("mucosa as given: {:.2g} mm, a10 {:.1f} Pa, a20 {:.1f} Pa\n", 1e3 * e.mucosa,
               fit.tissue.mucosa.a10, fit.tissue.mucosa.a20);
  fmt::print("residuals {:.3g} N RMS, chi2 {:.2f} a degree of freedom, {} simulations\n", fit.rms,
             fit.chi2_per_dof, fit.simulations);
}

int fit(const IndentCommand& o) {
  const ForceFile file = read_force_file(o.data);
  const ExperimentNotes notes = merged(o.notes, file.notes);
  const IndentationExperiment e = experiment_of(notes, o.layers == 2);
  if (!o.quiet)
    print_line(
        fmt::format("{} of {:g} mm on {:g} mm of tissue{}{}", to_string(e.indenter), 1e3 * e.radius,
                    1e3 * e.thickness,
                    e.mucosa > 0 ? fmt::format(", {:g} mm of it mucosa", 1e3 * e.mucosa) : "",
                    notes.indenter && notes.radius_mm && notes.thickness_mm
                        ? ""
                        : " (what neither the file nor an option says is assumed)"));
  const ForceData data = up_to(file.data, o.deepest_mm ? 1e-3 * *o.deepest_mm : 1e9);
  if (data.depth.size() < 5)
    throw InputError(fmt::format("--up-to-mm: {} rows of {} are left; expected at least 5",
                                 data.depth.size(), o.data));
  TissueFitOptions options{.mucosa = mucosa_of(notes),
                           .fit_mucosa = o.fit_mucosa,
                           .relative_scatter = o.relative_scatter};
  if (!o.quiet)
    options.progress = [](int simulation, double rms) {
      print_line(fmt::format("simulation {}: {:.3g} N RMS", simulation, rms));
    };
  std::optional<ModelDescription> base;
  if (!o.into.empty()) base = read_description(o.model);  // what is wrong with it is told at once
  const TissueFit found = fit_tissue(e, data, options);
  make_folder(o.out);
  write_text(o.out + "/result.json", fit_json(e, data, found, 2) + "\n");
  if (found) write_text(o.out + "/curve.csv", curve_csv(data, found));
  if (found) draw_fit(data, found, o.out);
  if (found && base) write_into(o, *base, found, e.mucosa);
  if (o.json) fmt::print("{}\n", fit_json(e, data, found));
  else if (found) print_fit(e, found);
  if (!found) print_line("genio: indent: " + found.message);
  return found ? done : no_answer;
}

int run_indent(const IndentCommand& asked) {
  IndentCommand o = asked;
  if (!o.indenter.empty()) o.notes.indenter = o.indenter;
  if (o.simulate) return simulate(o);
  if (o.data.empty()) throw InputError("--data: expected a file with force_N,depth_mm,sd");
  if (o.fit_mucosa && o.layers != 2)
    throw InputError("--fit-mucosa: there is no mucosa; expected --layers 2 beside it");
  return fit(o);
}

}  // namespace

Runner add_indent(Options& options) {
  auto o = std::make_shared<IndentCommand>();
  ExperimentNotes& n = o->notes;
  options.add("--data", o->data,
              "Measured curve: CSV with force_N, depth_mm and, if known, sd [N]");
  options.add("--layers", o->layers, "1: muscle; 2: muscle below a mucosa",
              {.shows_default = true, .range = {{1, 2}}});
  options.add("--out", o->out, "Folder for result.json and curve.csv", {.required = true});
  options.add("--indenter", o->indenter,
              "What presses; the pressure's depth is the mean over its circle (punch)",
              {.among = {"punch", "sphere", "pressure"}});
  options.add("--radius-mm", n.radius_mm, "Radius of the indenter (5)", {.positive = true});
  options.add("--thickness-mm", n.thickness_mm, "Thickness of the block with its mucosa (20)",
              {.positive = true});
  options.add("--half-width-mm", n.half_width_mm, "From the axis to a side (10 radii)",
              {.positive = true});
  options.add("--poisson", n.poisson_ratio, "Poisson ratio at rest (0.499)", {.positive = true});
  options.add("--mucosa-mm", n.mucosa_mm, "Thickness of the mucosa (1)", {.positive = true});
  options.add("--mucosa-a10-Pa", n.mucosa_a10_Pa, "Its a10 (384)", {.positive = true});
  options.add("--mucosa-a20-Pa", n.mucosa_a20_Pa, "Its a20 (0.469 of its a10)", {.positive = true});
  options.flag("--fit-mucosa", o->fit_mucosa, "Estimate the mucosa's a10 too");
  options.flag(
      "--relative-scatter", o->relative_scatter,
      "Without a column sd: forces scatter by the same part of each, not by the same force");
  options.add("--up-to-mm", o->deepest_mm, "Leave deeper rows out", {.positive = true});
  options.add("--model", o->model, "Model folder that --into takes all else from",
              {.only_with = {"--into"}});
  options.add("--into", o->into, "Model folder to write with the constants found",
              {.only_with = {"--data"}});
  options.flag("--simulate", o->simulate, "Write a simulated measurement, OUT/data.csv, instead",
               {.not_with = {"--data"}});
  options.add("--a10-Pa", o->a10, "Simulated: the muscle's a10 (192)",
              {.positive = true, .only_with = {"--simulate"}});
  options.add("--a20-Pa", o->a20, "Simulated: the muscle's a20 (90)",
              {.only_with = {"--simulate"}});
  options.add("--depth-mm", o->depth_mm, "Simulated: greatest depth (5)",
              {.positive = true, .only_with = {"--simulate"}});
  options.add("--rows", o->rows, "Simulated: depths (100)",
              {.range = {{5, 10000}}, .only_with = {"--simulate"}});
  options.add("--scatter", o->scatter, "Simulated: standard deviation over force (0.05)",
              {.only_with = {"--simulate"}});
  options.add("--seed", o->seed, "Simulated: of the random numbers (1)",
              {.range = {{0, 1 << 30}}, .only_with = {"--simulate"}});
  options.flag("--json", o->json, "One JSON object on standard output");
  options.flag("--quiet", o->quiet, "No remarks, no progress");
  options.footer(
      "Example: genio indent --data data/examples/indentation/rear_muscle.csv "
      "--layers 1 --out rear");
  return [o] { return run_indent(*o); };
}

}  // namespace genio::cli
