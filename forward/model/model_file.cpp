#include "forward/model/model_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "forward/base/nearest_name.hpp"
#include "forward/base/printed_text.hpp"
#include "forward/base/text_file.hpp"
#include "forward/base/toml_reader.hpp"
#include "forward/effects/modes/mode_files.hpp"
#include "forward/geometry/vtk_io.hpp"
#include "forward/model/build_effects.hpp"

namespace genio {
namespace {

constexpr double farthest = 10;  // from the origin [m]; distances to what is farther overflow

/// A surface of the model. Throws InputError where no bone beside a tongue has it.
TriangleSurface bone_surface(const std::string& path) {
  TriangleSurface surface = read_surface(path);
  for (const Vec3& x : surface.vertices)
    if (!(x.cwiseAbs().maxCoeff() < farthest))
      throw InputError(fmt::format(
          "{}: has a vertex at ({:g}, {:g}, {:g}); expected metres, within {:g} of the origin",
          path, x[0], x[1], x[2], farthest));
  return surface;
}

namespace fs = std::filesystem;
using Reader = TomlReader;

const VtkArray& need(const std::map<std::string, VtkArray>& arrays, const std::string& name,
                     const std::string& path) {
  const auto it = arrays.find(name);
  if (it == arrays.end()) throw InputError(fmt::format("{}: array '{}' is missing", path, name));
  if (it->second.components != 1)
    throw InputError(fmt::format("{}: array '{}' must have one component", path, name));
  return it->second;
}

void read_mesh(const std::string& path, ModelDescription& d) {
  const VtkData data = read_vtk(path);
  d.mesh.nodes = data.points;
  for (size_t c = 0; c < data.cells.size(); ++c) {
    if (data.types[c] != 12 || data.cells[c].size() != 8)
      throw InputError(
          fmt::format("{}: cell {} has VTK type {}; expected 8-node hexahedra (type 12)", path, c,
                      data.types[c]));
    std::array<int, 8> e;
    std::copy(data.cells[c].begin(), data.cells[c].end(), e.begin());
    d.mesh.elements.push_back(e);
  }
  check_mesh(d.mesh, path);
  const auto& support = need(data.point_data, "support", path);
  for (size_t a = 0; a < support.values.size(); ++a) {
    const double s = support.values[a];
    if (s != 0 && s != 1 && s != 2)
      throw InputError(
          fmt::format("{}: node {} has support {}; expected 0 free, 1 jaw, 2 hyoid", path, a, s));
    d.supports.push_back(Support(int(s)));
  }
  const auto& mask = need(data.cell_data, "muscles", path);
  for (const double bits : mask.values)
    if (!(bits >= 0 && bits < 0x1p53))
      throw InputError(
          fmt::format("{}: array 'muscles' holds {}; expected a mask of muscles", path, bits));
  for (size_t c = 0; c < data.cells.size(); ++c)
    for (size_t m = 0; m < d.muscles.size(); ++m)
      if (uint64_t(mask.values[c]) >> m & 1) d.muscles[m].elements.push_back(int(c));
  read_mesh_modes(data, path, d);
}

void read_fibres(const std::string& path, ModelDescription& d) {
  const VtkData data = read_vtk(path);
  const auto& node = need(data.point_data, "node", path);
  const auto& muscle = need(data.cell_data, "muscle", path);
  std::vector<std::vector<int>> fixed(d.muscles.size());
  for (size_t c = 0; c < data.cells.size(); ++c) {
    const double m = muscle.values[c];
    if (!(m >= 0) || m >= double(d.muscles.size()))
      throw InputError(fmt::format("{}: fibre {} belongs to muscle {}; the model file has {}", path,
                                   c, m, d.muscles.size()));
    Fibre fibre;
    for (int p : data.cells[c]) {
      const double n = node.values[p];
      if (!(n >= -1) || n >= double(d.mesh.nodes.size()))
        throw InputError(
            fmt::format("{}: point {} sits on node {}; expected -1 (a fixed point) "
                        "to {}",
                        path, p, n, d.mesh.nodes.size() - 1));
      fibre.push_back({int(n), data.points[p]});
      if (n < 0) fixed[size_t(m)].push_back(p);
    }
    if (fibre.size() < 2)
      throw InputError(fmt::format("{}: fibre {} has fewer than 2 points", path, c));
    d.muscles[size_t(m)].fibres.push_back(std::move(fibre));
  }
  for (const auto& m : d.muscles)
    if (m.fibres.empty()) throw InputError(fmt::format("{}: muscle {} has no fibre", path, m.name));
  std::vector<int> points;
  for (const auto& of_muscle : fixed)
    points.insert(points.end(), of_muscle.begin(), of_muscle.end());
  read_fibre_modes(data, points, path, d);
}

void read_muscles(const Reader& r, ModelDescription& d) {
  const auto* list = r.root().get("muscle");
  if (!list || !list->is_array_of_tables())
    throw InputError(r.path() + ": expected at least one [[muscle]]");
  std::set<std::string> names;
  for (const auto& node : *list->as_array()) {
    const auto& t = *node.as_table();
    r.only(t, {"name", "max_force_N"});
    Muscle m;
    m.name = r.text(t, "name");
    const auto* force = t.get("max_force_N");
    if (!force) r.fail(t, fmt::format("muscle {}: 'max_force_N' is missing", m.name));
    m.max_force = r.number(*force, "max_force_N");
    if (!(m.max_force > 0))
      r.fail(*force, fmt::format("muscle {}: 'max_force_N' must be above 0", m.name));
    if (!names.insert(m.name).second) r.fail(t, fmt::format("muscle {} is named twice", m.name));
    d.muscles.push_back(std::move(m));
  }
  if (d.muscles.size() > 52) throw InputError(r.path() + ": more than 52 muscles");
}

void read_effects(const Reader& r, ModelDescription& d) {
  for (const auto& [name, node] : r.table(r.root(), "effect")) {
    const std::string effect(name.str());
    const auto& known = effect_names();
    if (std::find(known.begin(), known.end(), effect) == known.end())
      r.fail(node, fmt::format("[effect.{}] is no effect; did you mean {}?", effect,
                               nearest_name(effect, known)));
    if (!node.is_table()) r.fail(node, fmt::format("[effect.{}] must be a table", effect));
    auto& table = d.effects[effect];
    for (const auto& [key, value] : *node.as_table())
      table[std::string(key.str())] = r.number(value, std::string(key.str()));
  }
}

}  // namespace

ModelDescription read_description(const std::string& given) {
  fs::path path = given;
  std::error_code none;
  if (fs::is_directory(path, none)) path /= "model.toml";
  if (!fs::exists(path, none))
    throw InputError(
        fmt::format("{}: no such model file; expected a model.toml or its folder", path.string()));
  const Reader r(path);
  const fs::path folder = path.parent_path();
  r.only(r.root(), {"model", "landmarks", "curve", "surfaces", "muscle", "effect"});
  ModelDescription d;
  const auto& model = r.table(r.root(), "model");
  r.only(model, {"name", "provenance", "mesh", "fibres", "density_kg_per_m3", "scale_sd"});
  d.name = r.text(model, "name");
  if (model.contains("provenance")) d.provenance = r.text(model, "provenance");
  if (const auto* density = model.get("density_kg_per_m3"))
    d.density = r.number(*density, "density_kg_per_m3");
  if (const auto* sd = model.get("scale_sd")) {
    d.scale_sd = r.number(*sd, "scale_sd");
    if (!(d.scale_sd > 0 && d.scale_sd <= 1)) r.fail(*sd, "scale_sd must be above 0 and at most 1");
  }
  read_muscles(r, d);
  read_mesh((folder / r.text(model, "mesh")).string(), d);
  read_fibres((folder / r.text(model, "fibres")).string(), d);

  const size_t n = d.mesh.nodes.size();
  const auto& marks = r.table(r.root(), "landmarks");
  r.only(marks, {"tip", "dorsum", "root"});
  for (auto [key, target] : {std::pair{"tip", &d.landmarks.tip},
                             {"dorsum", &d.landmarks.dorsum},
                             {"root", &d.landmarks.root}}) {
    const auto* node = marks.get(key);
    if (!node) r.fail(marks, fmt::format("landmark '{}' is missing", key));
    *target = r.node_number(*node, key, n);
  }
  const auto& curve = r.table(r.root(), "curve");
  const auto* line = curve.get("midsagittal");
  if (!line || !line->is_array() || line->as_array()->size() < 4)
    r.fail(curve, "'midsagittal' must list at least 4 node numbers");
  for (const auto& node : *line->as_array())
    d.midsagittal.push_back(r.node_number(node, "midsagittal", n));
  if (r.root().contains("surfaces")) {
    const auto& s = r.table(r.root(), "surfaces");
    r.only(s, {"palate", "jaw", "hyoid"});
    for (auto [key, target] :
         {std::pair{"palate", &d.palate}, {"jaw", &d.jaw}, {"hyoid", &d.hyoid}})
      if (s.contains(key)) *target = bone_surface((folder / r.text(s, key)).string());
  }
  read_surface_modes((folder / surface_modes_file).string(), d);
  read_effects(r, d);
  return d;
}

void write_description(const ModelDescription& d, const std::string& folder_name) {
  const fs::path folder = folder_name;
  make_folder(folder.string());
  VtkData mesh;
  mesh.points = d.mesh.nodes;
  VtkArray support{1, {}, true}, mask{1, {}, true};
  for (Support s : d.supports) support.values.push_back(double(int(s)));
  mask.values.assign(d.mesh.elements.size(), 0.0);
  for (size_t m = 0; m < d.muscles.size(); ++m)
    for (int e : d.muscles[m].elements) mask.values[e] += std::ldexp(1.0, int(m));
  for (const auto& e : d.mesh.elements) {
    mesh.cells.emplace_back(e.begin(), e.end());
    mesh.types.push_back(12);
  }
  mesh.point_data["support"] = support;
  mesh.cell_data["muscles"] = mask;
  add_mesh_modes(d, mesh);
  write_vtu((folder / "mesh.vtu").string(), mesh);

  VtkData fibres;
  VtkArray node{1, {}, true}, muscle{1, {}, true};
  for (size_t m = 0; m < d.muscles.size(); ++m)
    for (const Fibre& fibre : d.muscles[m].fibres) {
      std::vector<int> cell;
      for (const FibrePoint& p : fibre) {
        cell.push_back(int(fibres.points.size()));
        fibres.points.push_back(p.node >= 0 ? d.mesh.nodes[p.node] : p.anchor);
        node.values.push_back(p.node);
      }
      fibres.cells.push_back(std::move(cell));
      muscle.values.push_back(double(m));
    }
  fibres.point_data["node"] = node;
  fibres.cell_data["muscle"] = muscle;
  add_fibre_modes(d, fibres);
  write_vtp_lines((folder / "fibres.vtp").string(), fibres);
  write_surface_modes((folder / surface_modes_file).string(), d);

  PrintedText out;
  out.print(
      "# Genio tongue model. Lengths in metres; x backwards, y to the speaker's right, z up.\n"
      "[model]\nname = \"{}\"\nprovenance = \"{}\"\nmesh = \"mesh.vtu\"      # node array "
      "'support': 0 free, 1 jaw (fixed), 2 hyoid (horizontal plane)\n"
      "fibres = \"fibres.vtp\"  # one polyline a fibre; 'node' -1 is a fixed point\n"
      "density_kg_per_m3 = {}\nscale_sd = {}  # of the speaker's size, as a logarithm\n"
      "\n[landmarks]  # node numbers, from 0\ntip = {}\n"
      "dorsum = {}\nroot = {}\n\n[curve]  # floor, tip, dorsum, root\nmidsagittal = [{}]\n",
      d.name, d.provenance, d.density, d.scale_sd, d.landmarks.tip, d.landmarks.dorsum,
      d.landmarks.root, fmt::join(d.midsagittal, ", "));
  out.print("\n[surfaces]\n");
  for (auto [key, surface] : {std::pair{"palate", &d.palate}, {"jaw", &d.jaw}, {"hyoid", &d.hyoid}})
    if (*surface) {
      const std::string file = fmt::format("{}.obj", key);
      write_obj((folder / file).string(), **surface);
      out.print("{} = \"{}\"\n", key, file);
    }
  out.print(
      "\n# Bit k of the mesh's cell array 'muscles' and fibre array 'muscle' = k: the k-th "
      "below.\n");
  for (const auto& m : d.muscles)
    out.print("[[muscle]]\nname = \"{}\"\nmax_force_N = {}\n", m.name, m.max_force);
  out.print("\n# One table an effect; an absent table is an absent effect. SI units.\n");
  for (const auto& [effect, table] : d.effects) {
    out.print("[effect.{}]\n", effect);
    for (const auto& [key, value] : table) out.print("{} = {}\n", key, value);
  }
  write_text((folder / "model.toml").string(), out.text);
}

}  // namespace genio
