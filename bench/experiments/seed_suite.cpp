#include "bench/experiments/seed_suite.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <tuple>

#include "bench/experiments/seed_rows.hpp"
#include "bench/experiments/surface_edges.hpp"
#include "forward/base/text_file.hpp"
#include "forward/effects/muscles/muscles.hpp"
#include "forward/effects/tissue/named_tissue.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "forward/statics/equilibrium.hpp"
#include "report/pictures/shape_picture.hpp"
#include "report/pictures/svg.hpp"

namespace genio::bench {
namespace {

Model variant(const ModelDescription& tongue, const std::string& source, bool cadaver, bool palate,
              bool jaw) {
  ModelDescription d = tongue;
  d.effects["elasticity"] = named_tissue(cadaver ? "cadaver" : "living");
  if (!palate) d.effects.erase("palate_contact");
  if (!jaw) d.effects.erase("jaw_contact");
  return build_model(d, source);
}

void write_picture(const std::string& path, const std::string& svg) {
  write_text(path + ".svg", svg);
  write_png(path + ".png", svg, 1);
}

/// STY with its forces concentrated as the seed model has them, every fibre pulling with the same
/// tension along its whole length and so at its ends only, and distributed by tissue volume.
Json styloglossus(const ModelDescription& tongue, const std::string& source,
                  const std::string& folder) {
  const Model ours = variant(tongue, source, true, true, true);
  ModelParts parts = ours.parts();
  for (Muscle& muscle : parts.muscles)
    if (bilateral_name(muscle.name) == "STY")
      for (auto& s : muscle.segments) s.share = 1.0 / double(muscle.fibres.size());
  for (Effect& effect : parts.effects)
    if (effect.commands) effect = muscle_commands(parts.muscles);
  const Model seed(std::move(parts));
  Json j;
  for (const auto& [name, model] :
       {std::pair<const char*, const Model*>{"concentrated", &seed}, {"distributed", &ours}}) {
    Parameters p = default_parameters(*model);
    set_command(*model, "STY", 2, p);
    Workspace ws(*model);
    const Equilibrium e = solve_equilibrium(*model, p, model->rest, ws);
    if (!e) {
      j[name] = {{"status", "failed"}, {"message", e.message}};
      continue;
    }
    const EdgeSharpness edges = sharpness(*model, e.x);
    j[name] = {{"largest_deg", edges.largest}, {"p99_deg", edges.p99}};
    if (!folder.empty())
      write_picture(folder + "/STY_" + name,
                    draw_shape(*model, e.x, fmt::format("STY 1 N a side, {} forces", name)));
  }
  return j;
}

/// One posture of the suite.
struct SuiteCase {
  const PrintedRow& row;
  const char *law, *forces, *contact;
  bool pictured;
};

constexpr const char* columns[] = {"rear_forward_mm", "rear_back_mm", "rear_down_mm",
                                   "dorsum_up_mm",    "tip_dx_mm",    "tip_dz_mm",
                                   "groove_mm"};

Json case_json(const SuiteCase& c, const Model& m, const Equilibrium& e) {
  Json j = {{"row", c.row.name},
            {"law", c.law},
            {"forces", c.forces},
            {"contact", c.contact},
            {"status", e ? "converged" : "failed"},
            {"message", e.message}};
  if (!e) return j;
  const auto moves = measured_moves(m, e.x);
  for (const auto& [name, value] : moves) j[name] = value;
  j["volume_percent"] = 100 * (mesh_volume(m.mesh, e.x) / mesh_volume(m.mesh, m.rest) - 1);
  j["max_penetration_mm"] = 1e3 * max_penetration(m, e.x, e.parameters);
  j["paper"] = compared(c.row, moves);
  return j;
}

/// For people.
std::string case_line(const SuiteCase& c, const Json& j) {
  std::string line =
      fmt::format("{:<10} {:<8} {:<9} contact {:<7}", c.row.name, c.law, c.forces, c.contact);
  if (j["status"] != "converged") return line + "  " + j["message"].get<std::string>();
  for (const Json& p : j["paper"])
    line += fmt::format("  {} {:.1f} (paper {})", p["measure"].get<std::string>(),
                        p["ours_mm"].get<double>(), p["paper"].get<std::string>());
  return line;
}

std::string case_csv(const SuiteCase& c, const Json& j) {
  std::string csv = fmt::format("{},{},{},{}", c.row.name, c.law, c.forces, c.contact);
  if (j["status"] != "converged")
    return csv + fmt::format(",failed,,,,,,,,,,{}\n", j["message"].get<std::string>());
  csv += ",converged";
  for (const char* name : columns) csv += fmt::format(",{:.3f}", j[name].get<double>());
  return csv + fmt::format(",{:.4f},{:.4f},\n", j["volume_percent"].get<double>(),
                           j["max_penetration_mm"].get<double>());
}

/// Hands over every posture with its model and its shape.
template <class Act>
void each_case(const ModelDescription& tongue, const std::string& source, Act act) {
  for (const bool cadaver : {true, false})
    for (const auto& [contact, palate, jaw] : {std::tuple{"off", false, false},
                                               {"palate", true, false},
                                               {"jaw", false, true},
                                               {"both", true, true}}) {
      const Model m = variant(tongue, source, cadaver, palate, jaw);
      Workspace ws(m);
      for (const bool per_side : {true, false})
        for (const PrintedRow& row : printed_rows()) {
          Parameters p = default_parameters(m);
          for (const auto& [muscle, newtons] : row.forces)
            set_command(m, muscle, per_side ? 2 * newtons : newtons, p);
          act(SuiteCase{row, cadaver ? "cadaver" : "living", per_side ? "per side" : "in all",
                        contact, per_side && palate == jaw},
              m, solve_equilibrium(m, p, m.rest, ws));
        }
    }
}

Json run_seed_suite(const BenchOptions& o, const Progress& progress) {
  if (!o.out.empty()) std::filesystem::create_directories(o.out);
  const ModelDescription tongue = read_description(o.model);
  Json list = Json::array();
  std::string csv =
      fmt::format("row,law,forces,contact,status,{},volume_percent,penetration_mm,message\n",
                  fmt::join(columns, ","));
  each_case(tongue, o.model, [&](const SuiteCase& c, const Model& m, const Equilibrium& e) {
    const Json j = case_json(c, m, e);
    const std::string line = case_line(c, j);
    if (e && c.pictured && !o.out.empty())
      write_picture(fmt::format("{}/{}_{}_contact_{}", o.out, c.row.name, c.law, c.contact),
                    draw_shape(m, e.x, line));
    csv += case_csv(c, j);
    progress(line);
    list.push_back(j);
  });
  Json result = {{"model", tongue.name}, {"rows", list}};
  result["styloglossus_edges"] = styloglossus(tongue, o.model, o.out);
  if (!o.out.empty()) {
    write_text(o.out + "/suite.json", result.dump(2) + "\n");
    write_text(o.out + "/suite.csv", csv);
  }
  return result;
}

std::string edges_for_people(const Json& result) {
  std::string text;
  for (const char* how : {"concentrated", "distributed"})
    text += fmt::format(
        "STY, {} forces: edges of the surface up to {:.1f} deg sharper than at "
        "rest\n",
        how, result["styloglossus_edges"][how].value("largest_deg", std::nan("")));
  return text;
}

}  // namespace

Benchmark seed_suite_bench() {
  return {.name = "seed",
          .about = "The seed paper's forward results, on this tongue",
          .options = {{"--out", "folder for tables and pictures"}},
          .run = run_seed_suite,
          .for_people = edges_for_people};
}

}  // namespace genio::bench
