#include "report/answers/motion_report.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "forward/base/printed_text.hpp"
#include "forward/base/text_file.hpp"
#include "forward/geometry/vtk_io.hpp"
#include "forward/model/at_anatomy.hpp"

namespace genio {

void write_shape(const Model& model, const Positions& x, const std::string& path) {
  VtkData data;
  VtkArray displacement{3, {}, false};
  for (size_t a = 0; a < model.mesh.nodes.size(); ++a) {
    data.points.push_back(node_position(x, int(a)));
    const Vec3 u = data.points.back() - at_anatomy(model)->mesh.nodes[a];
    displacement.values.insert(displacement.values.end(), {u[0], u[1], u[2]});
  }
  for (const auto& e : model.mesh.elements) {
    data.cells.emplace_back(e.begin(), e.end());
    data.types.push_back(12);
  }
  data.point_data["displacement_m"] = std::move(displacement);
  write_vtu(path, data);
}

void write_motion(const Model& model, const Trajectory& trajectory, const std::string& folder) {
  namespace fs = std::filesystem;
  const fs::path frames = fs::path(folder) / "frames";
  make_folder(frames.string());
  PrintedText series, table;
  series.print("<VTKFile type=\"Collection\" version=\"0.1\"><Collection>\n");
  const std::pair<const char*, int> landmarks[] = {{"tip", model.landmarks.tip},
                                                   {"dorsum", model.landmarks.dorsum},
                                                   {"root", model.landmarks.root}};
  table.print("time_s");
  for (const auto& [name, node] : landmarks) table.print(",{0}_dx_mm,{0}_dy_mm,{0}_dz_mm", name);
  table.print(",kinetic_J,potential_J,dissipated_J,work_J\n");
  for (size_t i = 0; i < trajectory.instants.size(); ++i) {
    const Instant& now = trajectory.instants[i];
    const std::string file = fmt::format("frame_{:05}.vtu", i);
    write_shape(model, now.x, (frames / file).string());
    series.print("<DataSet timestep=\"{}\" file=\"frames/{}\"/>\n", now.time, file);
    table.print("{}", now.time);
    for (const auto& [name, node] : landmarks) {
      const Vec3 u =
          1e3 * (node_position(now.x, node) - node_position(at_anatomy(model)->rest, node));
      table.print(",{:.6g},{:.6g},{:.6g}", u[0], u[1], u[2]);
    }
    table.print(",{:.6g},{:.6g},{:.6g},{:.6g}\n", now.kinetic, now.potential, now.dissipated,
                now.work_done);
  }
  series.print("</Collection></VTKFile>\n");
  write_text((fs::path(folder) / "landmarks.csv").string(), table.text);
  write_text((fs::path(folder) / "motion.pvd").string(), series.text);
}

}  // namespace genio
