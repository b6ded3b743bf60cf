#include "bench/figures/forward/deformation_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/model/build_model.hpp"
#include "forward/tissue/tongue_faces.hpp"

namespace genio::bench {
namespace {

constexpr double touching_share = 0.01;  // of the muscle's force; a touch of less moves nothing

ModelDescription without_contacts(ModelDescription d, const Model& model) {
  for (const Effect& e : model.effects)
    if (e.contact) d.effects.erase(std::string(e.name()));
  return d;
}

Parameters commanded(const Model& m, const std::string& muscle, double force_a_side) {
  Parameters p = default_parameters(m);
  set_command(m, muscle, 2 * force_a_side, p);
  return p;
}

std::map<std::string, double> pressing(const Model& m, const Equilibrium& e, double least) {
  std::map<std::string, double> forces;
  for (const auto& contact : m.contacts) {
    Forces f = Forces::Zero(e.x.size());
    contact->add_force(e.x, contact.values(e.parameters), f);
    const double size = f.reshaped(3, f.size() / 3).colwise().norm().sum();
    if (size >= least) forces[std::string(contact->name())] = size;
  }
  return forces;
}

}  // namespace

std::vector<std::string> both_sided_muscles(const Model& model) {
  std::vector<std::string> names;
  for (const Muscle& muscle : model.muscles) {
    const std::string name = bilateral_name(muscle.name);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<double> deformation_levels(double maximum) {
  std::vector<double> levels;
  for (const double level : {0.1, 0.25, 0.5, 1.0, 2.0})
    if (level <= maximum) levels.push_back(level);
  if (levels.empty() || levels.back() < maximum) levels.push_back(maximum);
  return levels;
}

double maximum_a_side(const Model& model, const std::string& muscle) {
  double both = 0;
  for (const int k : command_parameters(model, muscle))
    both += model.parameters[size_t(k)].info.upper;
  return both / 2;
}

DeformationPair::DeformationPair(const ModelDescription& description, const std::string& source)
    : model_(build_model(description, source)),
      lone_(build_model(without_contacts(description, model_), source)),
      of_model_(model_),
      of_lone_(lone_) {}

std::vector<DeformationRow> DeformationPair::rows(const std::string& muscle) {
  std::vector<DeformationRow> rows;
  Positions start = model_.rest, lone_start = lone_.rest;
  for (const double force : deformation_levels(maximum_a_side(model_, muscle))) {
    DeformationRow row{muscle, force, {}, {}, {}, {}};
    const Parameters p = commanded(model_, muscle, force);
    row.small = solve_small_deformation(model_, p, of_model_);
    row.large = solve_equilibrium(model_, p, start, of_model_);
    if (row.large) {
      start = row.large.x;
      row.pressing = pressing(model_, row.large, touching_share * 2 * force);
    }
    row.lone = solve_equilibrium(lone_, commanded(lone_, muscle, force), lone_start, of_lone_);
    if (row.lone) lone_start = row.lone.x;
    rows.push_back(std::move(row));
  }
  return rows;
}

ShapeDifference difference(const Model& model, const Positions& large, const Positions& small) {
  const auto areas = nodal_areas(model.mesh, free_faces(model.mesh, model.supports));
  double apart = 0, moved = 0, area = 0;
  ShapeDifference result;
  for (size_t a = 0; a < areas.size(); ++a) {
    if (areas[a] == 0) continue;
    const int node = int(a);
    const double distance = (node_position(small, node) - node_position(large, node)).norm();
    result.largest = std::max(result.largest, distance);
    apart += areas[a] * distance * distance;
    moved += areas[a] * (node_position(large, node) - model.mesh.nodes[a]).squaredNorm();
    area += areas[a];
  }
  result.rms = std::sqrt(apart / area), result.relative = std::sqrt(apart / moved);
  return result;
}

ElementQuality element_quality(const Model& model, const Positions& x) {
  HexMesh mesh = model.mesh;
  for (size_t a = 0; a < mesh.nodes.size(); ++a) mesh.nodes[a] = node_position(x, int(a));
  ElementQuality result{mesh_volume(model.mesh, x) / mesh_volume(model.mesh, model.rest) - 1,
                        std::numeric_limits<double>::infinity(), 0};
  for (int e = 0; e < int(mesh.elements.size()); ++e) {
    const auto corners = corner_jacobians(mesh, e);
    const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
    result.folded += *least <= 0;
    result.least_ratio =
        std::min(result.least_ratio, *least / std::max(std::abs(*least), std::abs(*most)));
  }
  return result;
}

double first_reached(const std::vector<double>& forces, const std::vector<double>& values,
                     double bound) {
  for (size_t i = 0; i < values.size(); ++i) {
    if (values[i] < bound) continue;
    if (i == 0) return 0;
    const double along = std::log(bound / values[i - 1]) / std::log(values[i] / values[i - 1]);
    return forces[i - 1] * std::pow(forces[i] / forces[i - 1], along);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace genio::bench
