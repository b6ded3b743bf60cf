#include "speaker/adaptation/plane_registration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace genio {
namespace {

constexpr double pair_spacing = 3e-3, thickness = 5e-3;  // [m]
// Bending against squared distances, from affine to close; the last that folds nothing is taken.
constexpr std::array smoothings = {10.0, 2.0, 0.5, 0.1, 0.02};
constexpr double least_part = 0.25;  // of the affine stretch that a smooth map may come down to
// A corner's energy against the distances of the line [m]: stiff at first, then soft.
constexpr std::array stiffnesses = {3e-4, 1e-4, 3e-5, 3e-5, 1e-5, 1e-5, 3e-6, 3e-6, 3e-6};

// Where the line is still farther off [m], tissue is softened again, this often by half.
constexpr double close_enough = 0.3e-3;
constexpr size_t most_softer = 5;
constexpr double far_from_notch = 2e-3;  // of the place that belongs at its bottom [m]

/// The faces as one layer of elements, so that solids and planes share their energies.
struct Sheet {
  HexMesh mesh;
  std::vector<int> numbers;    ///< of the model's nodes; the sheet's second layer repeats them
  std::vector<int> line_node;  ///< of the sheet, for each node of the model's line
};

Sheet make_sheet(const ModelDescription& model, const ModelLine& line) {
  Sheet sheet;
  std::map<int, int> at;
  for (const Quad& q : line.faces)
    for (int a : q)
      if (at.try_emplace(a, int(at.size())).second) sheet.numbers.push_back(a);
  const int n = int(sheet.numbers.size());
  for (double y : {0.0, -thickness})
    for (int a : sheet.numbers)
      sheet.mesh.nodes.emplace_back(model.mesh.nodes[size_t(a)][0], y,
                                    model.mesh.nodes[size_t(a)][2]);
  for (const Quad& q : line.faces) {
    std::array<int, 8> e{};
    for (size_t i = 0; i < 4; ++i) e[i] = at.at(q[i]), e[i + 4] = n + at.at(q[i]);
    sheet.mesh.elements.push_back(e);
  }
  for (int a : line.nodes) sheet.line_node.push_back(at.at(a));
  return sheet;
}

HexMesh mapped(HexMesh mesh, const ThinPlateMap& map) {
  for (Vec3& x : mesh.nodes) x = map.in_space(x, 1);
  return mesh;
}

/// Whether no corner is folded, or much smaller than the affine map would have it.
bool keeps_corners(const HexMesh& rest, const HexMesh& moved, double stretch) {
  for (size_t e = 0; e < rest.elements.size(); ++e) {
    const auto before = corner_jacobians(rest, int(e)), after = corner_jacobians(moved, int(e));
    for (size_t c = 0; c < 8; ++c)
      if (!(after[c] > least_part * stretch * before[c])) return false;
  }
  return true;
}

/// Pulls of both layers alike.
std::vector<Pull> on_both_layers(std::vector<Pull> pulls, int nodes) {
  const size_t n = pulls.size();
  for (size_t k = 0; k < n; ++k) {
    Pull second = pulls[k];
    for (int& a : second.nodes)
      if (a >= 0) a += nodes;
    second.goal[1] = -thickness;
    pulls.push_back(second);
  }
  return pulls;
}

}  // namespace

PlaneRegistration register_plane(const ModelDescription& model, const ModelLine& line,
                                 const SpeakerOutline& outline) {
  const Sheet sheet = make_sheet(model, line);
  const int n = int(sheet.numbers.size());
  const Polyline theirs(outline.tongue());
  const TongueLandmarks marks = tongue_landmarks(outline);
  PlaneRegistration result;
  LineMatch match = match_by_landmarks(line, rest_positions(model.mesh), outline, pair_spacing);
  const std::vector<PlacePair> pairs = match.pairs(theirs);
  result.coarse = affine_map(pairs);
  const double stretch = result.coarse.derivative(pairs.front().from).determinant();
  if (!(stretch > 0.1 && stretch < 10))
    throw InputError(fmt::format(
        "{}: segment tongue: the model's section would be scaled by {:.3g}; expected a tongue that "
        "runs from the hyoid over mandible and tip to the vallecula",
        outline.name(), stretch));
  result.scale = std::sqrt(stretch);
  result.match = match;
  ThinPlateMap map = result.coarse;
  for (double smoothing : smoothings) {
    map = slid_map(match, theirs, map, smoothing);
    if (!keeps_corners(sheet.mesh, mapped(sheet.mesh, map), stretch)) break;
    result.coarse = map, result.match = match;
  }
  if (const auto& notch = result.match.notch) {
    const int node = line.nodes[notch->node];
    const Vec3& rest = model.mesh.nodes[size_t(node)];
    const Vec2 there = result.coarse(Vec2(rest[0], rest[2]));
    if ((there - theirs.at(notch->at)).norm() > far_from_notch) result.match.lead_into_notch();
  }
  const HexMesh start = mapped(sheet.mesh, result.coarse);
  FoldFreeProblem problem{&sheet.mesh, corner_shapes(start), {}, 1, 0, 0.35, {}, {}};
  Positions x = rest_positions(start);
  for (size_t e = 0; e < start.elements.size(); ++e)  // two layers share what one face weighs
    problem.volumes.push_back(2 * element_volume(start, x, int(e)) / thickness);
  problem.supports.assign(start.nodes.size(), held_along(false, true, false));
  for (size_t round = 0; round < stiffnesses.size() + most_softer; ++round) {
    const size_t softer = round < stiffnesses.size() ? 0 : round - stiffnesses.size() + 1;
    if (softer > 0) {
      const LineDistances now = line_distances(line, sheet.line_node, x, theirs, marks);
      if (std::max(now.free_rms, now.floor_rms) < close_enough) break;
    }
    problem.stiffness =
        stiffnesses[std::min(round, stiffnesses.size() - 1)] / std::pow(2.0, softer);
    problem.quality = problem.stiffness;
    problem.pulls =
        on_both_layers(line_pulls(line, sheet.line_node, x, theirs, result.match, {}), n);
    x = minimise_fold_free(problem, x, {.most_steps = 15, .small_step = 1e-5}).x;
  }
  result.numbers = sheet.numbers;
  for (int k = 0; k < n; ++k)
    result.nodes.push_back({{sheet.mesh.nodes[size_t(k)][0], sheet.mesh.nodes[size_t(k)][2]},
                            {x[3 * k], x[3 * k + 2]}});
  result.distances = line_distances(line, sheet.line_node, x, theirs, marks);
  return result;
}

}  // namespace genio
