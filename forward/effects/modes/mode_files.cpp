#include "forward/effects/modes/mode_files.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace genio {
namespace {

const std::string prefix = "anatomy_";

struct ModedSurface {
  const char* name;
  std::optional<TriangleSurface> ModelDescription::*surface;
  std::vector<Vec3> AnatomyMode::*field;
};
const ModedSurface moded_surfaces[] = {{"palate", &ModelDescription::palate, &AnatomyMode::palate},
                                       {"jaw", &ModelDescription::jaw, &AnatomyMode::jaw},
                                       {"hyoid", &ModelDescription::hyoid, &AnatomyMode::hyoid}};

std::vector<Vec3> displacements(const VtkData& data, const std::string& mode,
                                const std::string& path) {
  const std::string name = prefix + mode;
  const auto array = data.point_data.find(name);
  if (array == data.point_data.end())
    throw InputError(fmt::format("{}: array '{}' is missing; the mesh has it", path, name));
  if (array->second.components != 3)
    throw InputError(fmt::format("{}: array '{}' has {} components; expected 3", path, name,
                                 array->second.components));
  std::vector<Vec3> result;
  for (size_t i = 0; i < data.points.size(); ++i) {
    result.push_back(Eigen::Map<const Vec3>(&array->second.values[3 * i]));
    if (!result.back().allFinite())
      throw InputError(fmt::format("{}: array '{}' is not finite at point {}", path, name, i));
  }
  return result;
}

void refuse_others(const VtkData& data, const std::string& path, const ModelDescription& d) {
  for (const auto& entry : data.point_data) {
    const std::string& name = entry.first;
    if (!name.starts_with(prefix)) continue;
    const auto is_it = [&](const AnatomyMode& m) { return prefix + m.name == name; };
    if (std::none_of(d.modes.begin(), d.modes.end(), is_it))
      throw InputError(fmt::format("{}: array '{}' is of no mode that the mesh has", path, name));
  }
}

void add(VtkData& data, const std::string& mode, const std::vector<Vec3>& field) {
  VtkArray& array = data.point_data[prefix + mode];
  array.components = 3;
  for (const Vec3& u : field) array.values.insert(array.values.end(), u.begin(), u.end());
}

}  // namespace

void read_mesh_modes(const VtkData& mesh, const std::string& path, ModelDescription& d) {
  for (const auto& [name, array] : mesh.point_data)
    if (name.starts_with(prefix)) {
      const std::string mode = name.substr(prefix.size());
      if (mode.empty())
        throw InputError(fmt::format("{}: array '{}' lacks the mode's name", path, name));
      d.modes.push_back({.name = mode,
                         .nodes = displacements(mesh, mode, path),
                         .fixed_points = {},
                         .palate = {},
                         .jaw = {},
                         .hyoid = {}});
    }
}

void read_fibre_modes(const VtkData& fibres, const std::vector<int>& points,
                      const std::string& path, ModelDescription& d) {
  for (AnatomyMode& mode : d.modes) {
    const auto all = displacements(fibres, mode.name, path);
    for (const int i : points) mode.fixed_points.push_back(all[size_t(i)]);
  }
  refuse_others(fibres, path, d);
}

void read_surface_modes(const std::string& path, ModelDescription& d) {
  size_t count = 0, lines = 0;
  for (const ModedSurface& s : moded_surfaces)
    if (d.*s.surface) count += (d.*s.surface)->vertices.size(), ++lines;
  if (d.modes.empty() || count == 0) return;
  const VtkData data = read_vtk(path);
  if (data.cells.size() != lines)
    throw InputError(fmt::format("{}: has {} polylines; expected one a surface of the model, {}",
                                 path, data.cells.size(), lines));
  for (AnatomyMode& mode : d.modes) {
    const auto all = displacements(data, mode.name, path);
    size_t line = 0;
    for (const ModedSurface& s : moded_surfaces) {
      if (!(d.*s.surface)) continue;
      const std::vector<int>& points = data.cells[line++];
      if (points.size() != (d.*s.surface)->vertices.size())
        throw InputError(fmt::format("{}: polyline {} has {} points; the {} has {} vertices", path,
                                     line - 1, points.size(), s.name,
                                     (d.*s.surface)->vertices.size()));
      for (const int i : points) (mode.*s.field).push_back(all[size_t(i)]);
    }
  }
  refuse_others(data, path, d);
}

void add_mesh_modes(const ModelDescription& d, VtkData& mesh) {
  for (const AnatomyMode& mode : d.modes) add(mesh, mode.name, mode.nodes);
}

void add_fibre_modes(const ModelDescription& d, VtkData& fibres) {
  for (const AnatomyMode& mode : d.modes) {
    std::vector<Vec3> field;
    size_t next = 0;
    for (const Muscle& muscle : d.muscles)
      for (const Fibre& fibre : muscle.fibres)
        for (const FibrePoint& p : fibre)
          field.push_back(p.node >= 0 ? mode.nodes[size_t(p.node)] : mode.fixed_points[next++]);
    add(fibres, mode.name, field);
  }
}

void write_surface_modes(const std::string& path, const ModelDescription& d) {
  VtkData data;
  for (const ModedSurface& s : moded_surfaces) {
    if (!(d.*s.surface)) continue;
    auto& line = data.cells.emplace_back();
    for (const Vec3& x : (d.*s.surface)->vertices)
      line.push_back(int(data.points.size())), data.points.push_back(x);
  }
  if (d.modes.empty() || data.points.empty()) return;
  for (const AnatomyMode& mode : d.modes) {
    std::vector<Vec3> field;
    for (const ModedSurface& s : moded_surfaces)
      field.insert(field.end(), (mode.*s.field).begin(), (mode.*s.field).end());
    add(data, mode.name, field);
  }
  write_vtp_lines(path, data);
}

}  // namespace genio
