#include "bench/figures/forward/deformation.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/figures/forward/deformation_pictures.hpp"
#include "bench/figures/forward/deformation_table.hpp"
#include "forward/base/text_file.hpp"
#include "forward/model/model_file.hpp"

namespace genio::bench {
namespace {

Json run_deformation(const BenchOptions& o, const Progress& progress) {
  DeformationPair pair(read_description(o.model), o.model);
  std::vector<std::string> muscles = both_sided_muscles(pair.model());
  if (!o.only.empty()) {
    command_parameters(pair.model(), o.only);  // refuses what is no muscle
    muscles = {bilateral_name(o.only)};
  }
  if (!o.out.empty()) std::filesystem::create_directories(o.out);
  Json all = Json::array(), limits = Json::array();
  for (const std::string& muscle : muscles) {
    const std::vector<DeformationRow> rows = pair.rows(muscle);
    std::vector<Json> of_muscle;
    for (const DeformationRow& row : rows) {
      of_muscle.push_back(deformation_json(pair.model(), row));
      all.push_back(of_muscle.back());
    }
    limits.push_back(deformation_limits(of_muscle));
    if (!o.out.empty()) draw_muscle(pair.model(), rows, o.out);
    progress(
        fmt::format("{}: {} forces up to {:.4g} N a side", muscle, rows.size(), rows.back().force));
  }
  Json result = {{"model", pair.model().name}, {"rows", all}, {"limits", limits}};
  if (!o.out.empty()) {
    draw_differences(all, o.out);
    write_text(o.out + "/deformation.json", result.dump(2) + "\n");
  }
  return result;
}

}  // namespace

Benchmark deformation_bench() {
  return {.name = "deformation",
          .about = "Small deformation beside large, by muscle and force",
          .options = {{"--only", "this muscle alone, both sides alike (all)"},
                      {"--out", "folder for the figures and pictures"}},
          .run = run_deformation,
          .for_people = deformation_text};
}

}  // namespace genio::bench
