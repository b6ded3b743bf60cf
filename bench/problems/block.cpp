#include "bench/problems/block.hpp"

#include <memory>

#include "forward/effects/surroundings/dead_load.hpp"
#include "forward/effects/tissue/viscosity.hpp"
#include "forward/geometry/box_mesh.hpp"

namespace genio::bench {
namespace {

const TissueConstants constants{192, 90, 191872};
constexpr double loaded_depth = 0.015;  // [m]

std::vector<int> loaded_elements(const HexMesh& mesh) {
  std::vector<int> loaded;
  for (size_t e = 0; e < mesh.elements.size(); ++e)
    if (mesh.nodes[size_t(mesh.elements[e][6])][0] < loaded_depth + 1e-9) loaded.push_back(int(e));
  return loaded;
}

}  // namespace

Model block(const std::array<int, 3>& cells) {
  ModelParts m;
  m.name = "block";
  m.mesh = box_mesh(Vec3(0.06, 0.04, 0.05), cells);
  for (const Vec3& x : m.mesh.nodes)
    m.supports.push_back(x[2] < 1e-9 ? Support::fixed : Support::free);
  Forces weights = Forces::Zero(Eigen::Index(3 * m.mesh.nodes.size()));
  for (int e : loaded_elements(m.mesh))
    for (const int a : m.mesh.elements[size_t(e)]) weights[3 * a] += 1;
  weights /= weights.sum();
  m.tissue_mass = tissue_mass(m.mesh, 1040);
  m.effects = {elastic_tissue(m.mesh, constants, true),
               {.potential = std::make_shared<DeadLoad>("load", weights, 1.0)},
               {.dissipation = std::make_shared<Viscosity>(m.tissue_mass, 40, 0.03)}};
  return Model(std::move(m));
}

Model block(int split) { return block({12 * split, 8 * split, 10 * split}); }

int top_centre(int split) {
  const int nx = 12 * split, ny = 8 * split, nz = 10 * split;
  return (nz * (ny + 1) + ny / 2) * (nx + 1) + nx / 2;
}

CalculixProblem block_for_calculix(const Model& m, double newtons) {
  CalculixProblem p{m.mesh, m.supports, constants, loaded_elements(m.mesh), Vec3::Zero()};
  double volume = 0;
  for (int e : p.loaded) volume += element_volume(m.mesh, m.rest, e);
  p.force[0] = newtons / volume;
  return p;
}

}  // namespace genio::bench
