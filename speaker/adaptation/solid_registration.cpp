#include "speaker/adaptation/solid_registration.hpp"

#include <algorithm>
#include <cmath>

#include "speaker/elastic/mirror_halves.hpp"

namespace genio {
namespace {

constexpr double tissue_stiffness = 3e-6;  // of a corner's energy against squared distances [m]
constexpr double wanted_ratio = 0.12;      // a little above the least one
constexpr int most_repairs = 6;
// What holds nodes at their places, against squared distances over volume.
constexpr double node_hold = 0.3;

/// The mesh with all nodes moved.
HexMesh moved_mesh(HexMesh mesh, const Positions& x) {
  for (size_t a = 0; a < mesh.nodes.size(); ++a) mesh.nodes[a] = node_position(x, int(a));
  return mesh;
}

/// The farthest shape along the way from one to another in which no corner is folded.
Positions farthest_unfolded(const HexMesh& mesh, const Positions& from, const Positions& to) {
  for (double part = 1; part > 0.01; part -= 0.05) {
    const Positions x = from + part * (to - from);
    const HexMesh there = moved_mesh(mesh, x);
    bool fine = true;
    for (size_t e = 0; fine && e < mesh.elements.size(); ++e) {
      const auto before = corner_jacobians(mesh, int(e)), after = corner_jacobians(there, int(e));
      for (size_t c = 0; c < 8; ++c) fine &= after[c] > 0.02 * before[c];
    }
    if (fine) return x;
  }
  return from;
}

std::vector<double> nodal_volumes(const HexMesh& mesh) {
  std::vector<double> volumes(mesh.nodes.size(), 0.0);
  const Positions x = rest_positions(mesh);
  for (size_t e = 0; e < mesh.elements.size(); ++e)
    for (int a : mesh.elements[e])
      volumes[size_t(a)] += std::abs(element_volume(mesh, x, int(e))) / 8;
  return volumes;
}

}  // namespace

double least_corner_jacobian_ratio(const HexMesh& mesh) {
  double least = 1;
  for (size_t e = 0; e < mesh.elements.size(); ++e)
    least = std::min(least, corner_jacobian_ratio(mesh, int(e)));
  return least;
}

SolidRegistration register_solid(const ModelDescription& model, const ModelLine& line,
                                 const PlaneRegistration& plane, const SpeakerOutline& outline,
                                 double lateral) {
  MirrorHalves halves = mirror_halves(model.mesh);
  const bool symmetric = !halves.half.elements.empty();
  const HexMesh& rest = symmetric ? halves.half : model.mesh;
  const auto here = [&](int a) { return symmetric ? halves.in_half[size_t(a)] : a; };
  const Polyline theirs(outline.tongue());
  const TongueLandmarks marks = tongue_landmarks(outline);

  // Where the plane's map takes everything, and the affine map, which folds nothing.
  const ThinPlateMap map(plane.nodes, 1e-6);
  const ThinPlateMap straight = affine_map(plane.nodes);
  HexMesh goal = rest, affine = rest;
  for (size_t a = 0; a < rest.nodes.size(); ++a) {
    goal.nodes[a] = map.in_space(rest.nodes[a], lateral);
    affine.nodes[a] = straight.in_space(rest.nodes[a], lateral);
  }
  for (size_t k = 0; k < plane.numbers.size(); ++k) {
    const Vec2& to = plane.nodes[k].to;
    goal.nodes[size_t(here(plane.numbers[k]))] = Vec3(to[0], 0, to[1]);
  }
  SolidRegistration result;
  for (size_t e = 0; e < rest.elements.size(); ++e)
    if (!(corner_jacobian_ratio(goal, int(e)) > least_corner_ratio))
      result.repaired += symmetric ? 2 : 1;

  FoldFreeProblem problem{&rest, {}, {}, tissue_stiffness, tissue_stiffness, 0.35, {}, {}};
  const Positions straight_shape = rest_positions(affine), goal_shape = rest_positions(goal);
  Positions x = farthest_unfolded(affine, straight_shape, goal_shape);
  problem.shapes = corner_shapes(affine);
  const std::vector<double> volumes = nodal_volumes(affine);
  for (size_t e = 0; e < rest.elements.size(); ++e)
    problem.volumes.push_back(element_volume(affine, straight_shape, int(e)));
  for (const Vec3& p : rest.nodes)
    problem.supports.push_back(std::abs(p[1]) < on_plane ? held_along(false, true, false)
                                                         : Support::free);
  std::vector<int> line_node;
  for (int a : line.nodes) line_node.push_back(here(a));
  for (int round = 0; round <= most_repairs; ++round) {
    LinePullOptions o;
    o.weight = solid_line_depth;
    problem.pulls = line_pulls(line, line_node, x, theirs, plane.match, o);
    for (size_t a = 0; a < rest.nodes.size(); ++a)
      problem.pulls.push_back({{int(a), -1, -1, -1},
                               {1, 0, 0, 0},
                               goal.nodes[a],
                               node_hold * volumes[a] * Mat3::Identity()});
    x = minimise_fold_free(problem, x, {.most_steps = round == 0 ? 30 : 12, .small_step = 1e-5}).x;
    result.min_jacobian = least_corner_jacobian_ratio(moved_mesh(rest, x));
    if (round > 0 && result.min_jacobian >= wanted_ratio) break;
    problem.quality *= 4;
    if (round > 2) problem.wanted = 0.5;
  }
  if (symmetric) x = halves.on_both(x);
  result.mesh = moved_mesh(model.mesh, x);
  result.min_jacobian = least_corner_jacobian_ratio(result.mesh);
  result.distances = line_distances(line, line.nodes, x, theirs, marks);
  return result;
}

}  // namespace genio
