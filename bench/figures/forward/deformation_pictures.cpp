#include "bench/figures/forward/deformation_pictures.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "forward/base/text_file.hpp"
#include "report/pictures/plot.hpp"
#include "report/pictures/shape_picture.hpp"
#include "report/pictures/svg.hpp"

namespace genio::bench {
namespace {

constexpr double usual_force = 2;  // a side [N]: more than speech asks of most muscles

void write_picture(const std::string& path, const std::string& svg) {
  write_text(path + ".svg", svg);
  write_png(path + ".png", svg, 1.5);
}

SidePanel panel(const DeformationRow& row) {
  std::string below = fmt::format("{:.4g} N a side", row.force);
  if (!row.pressing.empty()) below += ", touches bone";
  below += "; lips left [mm]";
  return {below,
          {{"large deformation", blue, row.large.x}, {"small deformation", red, row.small.x}}};
}

}  // namespace

void draw_muscle(const Model& model, const std::vector<DeformationRow>& rows,
                 const std::string& folder) {
  const DeformationRow *usual = nullptr, *largest = nullptr;
  for (const DeformationRow& row : rows) {
    if (!row.large || !row.small) continue;
    largest = &row;
    if (row.force <= usual_force) usual = &row;
  }
  if (!largest) return;
  std::vector<SidePanel> panels;
  if (usual && usual != largest) panels.push_back(panel(*usual));
  panels.push_back(panel(*largest));
  write_picture(folder + "/" + largest->muscle, draw_side_by_side(model, panels, largest->muscle));
}

void draw_differences(const Json& rows, const std::string& folder) {
  for (const auto& [key, title] :
       {std::pair{"difference", "Small against large deformation"},
        {"difference_without_contact", "Small against large deformation, without contact"}}) {
    std::vector<Series> series;
    for (const Json& row : rows) {
      const std::string muscle = row["muscle"];
      if (series.empty() || series.back().name != muscle) series.push_back({muscle, {}});
      if (row[key].is_null()) continue;
      series.back().points.emplace_back(row["force_N"].get<double>(),
                                        100 * row[key]["relative"].get<double>());
    }
    write_picture(folder + "/" + key,
                  plot(title, "force a side [N]", "RMS difference [%]", series, true, true));
  }
}

}  // namespace genio::bench
