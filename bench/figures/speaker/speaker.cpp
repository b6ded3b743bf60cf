#include "bench/figures/speaker/speaker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/figures/speaker/hidden_anatomy.hpp"
#include "bench/figures/speaker/outline_sheet.hpp"
#include "bench/figures/speaker/sparse.hpp"
#include "bench/problems/clock.hpp"
#include "forward/model/build_model.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio::bench {
namespace {

constexpr double command = 1;  // of GGP, both sides together [N]

/// Whether the model has an equilibrium under the command, without gravity.
Equilibrium pulled_tongue(const ModelDescription& description) {
  ModelDescription d = description;
  d.effects.erase("gravity");
  const Model m = build_model(d, d.name);
  Parameters p = default_parameters(m);
  set_command(m, "GGP", command, p);
  Workspace ws(m);
  return solve_equilibrium(m, p, m.rest, ws);
}

Json speaker_row(const BenchOptions& o, const ModelDescription& base, const std::string& speaker,
                 std::vector<OutlineDrawing>& drawings, const Progress& progress) {
  Json row = {{"speaker", speaker}};
  Adaptation a;
  row["seconds"] = seconds([&] { a = adapt_model(base, o.model, read_outline(o.data, speaker)); });
  row["rms_mm"] = 1e3 * a.distances.rms, row["max_mm"] = 1e3 * a.distances.most;
  row["free_rms_mm"] = 1e3 * a.distances.free_rms,
  row["floor_rms_mm"] = 1e3 * a.distances.floor_rms;
  row["palate_rms_mm"] = 1e3 * a.palate_rms;
  row["rest_overlap_mm"] = 1e3 * a.rest_overlap;
  row["min_jacobian"] = a.min_jacobian, row["volume_cm3"] = 1e6 * a.volume;
  row["scale"] = a.scale, row["max_force_scale"] = a.max_force_scale;
  row["repaired_elements"] = a.repaired, row["valid"] = bool(a);
  const Equilibrium e = pulled_tongue(a.model);
  row["equilibrium"] = bool(e);
  if (!e) row["message"] = e.message;
  progress(fmt::format(
      "speaker {:>2}: {:.3f} mm RMS (free {:.3f}, floor {:.3f}), at most {:.2f}; palate {:.2f}; "
      "ratio {:.3f}, {} repaired; {:.1f} cm3; {:.1f} s; GGP {}",
      speaker, 1e3 * a.distances.rms, 1e3 * a.distances.free_rms, 1e3 * a.distances.floor_rms,
      1e3 * a.distances.most, 1e3 * a.palate_rms, a.min_jacobian, a.repaired, 1e6 * a.volume,
      row["seconds"].get<double>(), e ? "found" : e.message));
  drawings.push_back({speaker, std::move(a)});
  return row;
}

Json outlines(const BenchOptions& o, const Progress& progress) {
  const ModelDescription base = read_description(o.model);
  std::vector<std::string> speakers = outline_speakers(o.data);
  if (o.sample > 0) speakers.resize(std::min(speakers.size(), size_t(o.sample)));
  Json rows = Json::array();
  std::vector<OutlineDrawing> drawings;
  for (const std::string& speaker : speakers)
    rows.push_back(speaker_row(o, base, speaker, drawings, progress));
  Json j = {{"model", base.name}, {"speakers", rows.size()}};
  for (const char* key : {"rms_mm", "free_rms_mm", "floor_rms_mm", "max_mm", "seconds"}) {
    double worst = 0;
    for (const Json& row : rows) worst = std::max(worst, row[key].get<double>());
    j[std::string(key) + "_worst"] = worst;
  }
  double least = 1;
  int valid = 0, found = 0;
  for (const Json& row : rows) {
    least = std::min(least, row["min_jacobian"].get<double>());
    valid += row["valid"].get<bool>(), found += row["equilibrium"].get<bool>();
  }
  j["min_jacobian_worst"] = least, j["valid"] = valid, j["equilibria"] = found;
  j["each"] = rows;
  if (!o.out.empty()) draw_outlines(drawings, o.out);
  return j;
}

Json run_speaker_bench(const BenchOptions& o, const Progress& progress) {
  if (o.only == "sparse") return sparse_figures(o, progress);
  if (o.only == "anatomy") return hidden_anatomy_figures(o, progress);
  if (!o.only.empty() && o.only != "outlines")
    throw InputError(
        fmt::format("bench speaker --only {}: expected outlines, sparse or anatomy", o.only));
  return outlines(o, progress);
}

}  // namespace

Benchmark speaker_bench() {
  return {.name = "speaker",
          .about = "Models adapted to speakers' outlines: distances, elements, equilibria",
          .options = {{"--data", "CSV of the speakers' outlines", true},
                      {"--only", "outlines, sparse or anatomy (outlines)"},
                      {"--sample", "speakers (all; 8 with hidden anatomy)"},
                      {"--seed", "which are drawn"},
                      {"--out", "picture of all, without its ending"}},
          .run = run_speaker_bench};
}

}  // namespace genio::bench
