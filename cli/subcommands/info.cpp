#include "cli/subcommands/info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/file_hashes.hpp"
#include "cli/result_json.hpp"
#include "cli/support.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/recording/sensor_place.hpp"

namespace genio::cli {
namespace {

void print_info(const Model& m, double smallest_ratio, const ModelOrigin& origin) {
  fmt::print("{}\n  {} nodes, {} elements, {:.2f} cm^3, smallest corner-Jacobian ratio {:.4f}\n",
             m.name, m.mesh.nodes.size(), m.mesh.elements.size(), 1e6 * mesh_volume(m.mesh, m.rest),
             smallest_ratio);
  fmt::print("  made from: {}\n", origin.provenance.empty() ? "not stated" : origin.provenance);
  for (const auto& muscle : m.muscles)
    fmt::print("  {:<8} {:6.2f} N, {} fibres\n", muscle.name, muscle.max_force,
               muscle.fibres.size());
  for (const char* place : {"tip", "blade", "dorsum", "root"})
    fmt::print("  {:<8} {:.1f} mm behind the tip along the line\n", place,
               1e3 * behind_tip(m, place));
  fmt::print("  midsagittal line, floor to root: node (mm behind the tip)");
  for (const int n : m.midsagittal)
    fmt::print(" {} ({:.1f})", n, 1e3 * behind_tip(m, fmt::format("node:{}", n)));
  fmt::print("\n");
  for (const auto& [file, hash] : origin.hashes) fmt::print("  {} sha256 {}\n", file, hash);
  for (const auto& p : m.parameters)
    if (!p.is_command) fmt::print("  {} = {} {}\n", p.name.text(), p.info.value, p.info.unit);
}

}  // namespace

Runner add_info(Options& options) {
  auto model = std::make_shared<std::string>(default_model());
  auto json = std::make_shared<bool>(false);
  options.add("--model", *model, "Model folder or model.toml");
  options.flag("--json", *json, "One JSON object on standard output");
  options.footer("Example: genio info --json");
  return [=]() -> int {
    const Model read = read_model(*model);
    const auto here = at_anatomy(read);
    const Model& m = *here;
    double ratio = 1;
    for (size_t e = 0; e < m.mesh.elements.size(); ++e)
      ratio = std::min(ratio, corner_jacobian_ratio(m.mesh, int(e)));
    const ModelOrigin origin{read.description->provenance, model_file_hashes(*model)};
    if (*json) fmt::print("{}\n", info_json(m, ratio, origin));
    else print_info(m, ratio, origin);
    return done;
  };
}

}  // namespace genio::cli
