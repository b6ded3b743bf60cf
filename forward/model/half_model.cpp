#include "forward/model/half_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

/// New number of every node; -1 for those left behind.
std::vector<int> right_half(const HexMesh& mesh, const std::string& source, HexMesh& half) {
  std::vector<int> number(mesh.nodes.size(), -1);
  for (size_t a = 0; a < mesh.nodes.size(); ++a)
    if (mesh.nodes[a][1] > -on_plane) {
      number[a] = int(half.nodes.size());
      half.nodes.push_back(mesh.nodes[a]);
    }
  for (size_t e = 0; e < mesh.elements.size(); ++e) {
    int right = 0, left = 0;
    for (int a : mesh.elements[e]) {
      const double y = mesh.nodes[size_t(a)][1];
      right += y > on_plane, left += y < -on_plane;
    }
    if (right > 0 && left > 0)
      throw InputError(
          fmt::format("{}: element {} crosses the midsagittal plane y = 0; half a "
                      "tongue needs nodes on it",
                      source, e));
  }
  return number;
}

void keep_modes(const ModelDescription& whole, const std::vector<int>& number,
                const std::vector<size_t>& points, ModelDescription& half) {
  for (size_t k = 0; k < whole.modes.size(); ++k) {
    const AnatomyMode& of_whole = whole.modes[k];
    AnatomyMode& mode = half.modes[k];
    mode.nodes.clear(), mode.fixed_points.clear();
    for (size_t a = 0; a < number.size(); ++a)
      if (number[a] >= 0) mode.nodes.push_back(of_whole.nodes[a]);
    for (const size_t i : points) mode.fixed_points.push_back(of_whole.fixed_points[i]);
  }
}

}  // namespace

ModelDescription half_of(const ModelDescription& whole, const std::string& source) {
  ModelDescription d = whole;
  d.name = whole.name + ", right half";
  d.mesh = {};
  const std::vector<int> number = right_half(whole.mesh, source, d.mesh);
  std::vector<int> element(whole.mesh.elements.size(), -1);
  for (size_t e = 0; e < element.size(); ++e) {
    std::array<int, 8> nodes;
    bool kept = true;
    for (size_t i = 0; i < 8; ++i)
      kept &= (nodes[i] = number[size_t(whole.mesh.elements[e][i])]) >= 0;
    if (!kept) continue;
    element[e] = int(d.mesh.elements.size());
    d.mesh.elements.push_back(nodes);
  }
  if (2 * d.mesh.elements.size() != whole.mesh.elements.size())
    throw InputError(
        fmt::format("{}: {} of {} elements lie right of the midsagittal plane; half a "
                    "tongue needs two equal halves",
                    source, d.mesh.elements.size(), whole.mesh.elements.size()));
  d.supports.clear();
  for (size_t a = 0; a < whole.mesh.nodes.size(); ++a) {
    if (number[a] < 0) continue;
    Support s = whole.supports[a];
    if (s == Support::horizontal) s = Support::forward;
    if (s == Support::free && std::abs(whole.mesh.nodes[a][1]) < on_plane) s = in_midplane;
    d.supports.push_back(s);
  }
  d.muscles.clear();
  std::vector<size_t> kept_points;  // of the fixed points of fibres
  size_t points = 0;
  for (const Muscle& m : whole.muscles) {
    Muscle half{m.name, m.max_force, {}, {}, {}};
    if (bilateral_name(m.name) == m.name) half.max_force *= 0.5;
    const bool left = m.name.ends_with("_L");
    for (const Fibre& fibre : m.fibres) {
      Fibre kept = fibre;
      const size_t first = points;
      for (const FibrePoint& p : fibre) points += p.node < 0;
      const bool right = std::all_of(kept.begin(), kept.end(), [&](FibrePoint& p) {
        if (p.node < 0) return p.anchor[1] > -on_plane;
        return (p.node = number[size_t(p.node)]) >= 0;
      });
      if (!right || left) continue;
      half.fibres.push_back(std::move(kept));
      for (size_t i = first; i < points; ++i) kept_points.push_back(i);
    }
    for (int e : m.elements)
      if (element[size_t(e)] >= 0) half.elements.push_back(element[size_t(e)]);
    if (!half.fibres.empty()) d.muscles.push_back(std::move(half));
    if (left)  // what is said of it in other effects goes with it
      for (auto& [name, table] : d.effects) table.erase(m.name);
  }
  keep_modes(whole, number, kept_points, d);
  for (int* landmark : {&d.landmarks.tip, &d.landmarks.dorsum, &d.landmarks.root})
    *landmark = number[size_t(*landmark)];
  for (int& a : d.midsagittal) a = number[size_t(a)];
  return d;
}

}  // namespace genio
