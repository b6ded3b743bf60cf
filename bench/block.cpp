#include "bench/block.hpp"

#include <memory>

#include "forward/box_mesh.hpp"
#include "forward/effects/dead_load.hpp"
#include "forward/effects/elasticity.hpp"
#include "forward/effects/viscosity.hpp"

namespace genio::bench {

Model block(int split) {
  Model m;
  m.name = "block";
  m.mesh = box_mesh(Vec3(0.06, 0.04, 0.05), {12 * split, 8 * split, 10 * split});
  for (const Vec3& x : m.mesh.nodes)
    m.supports.push_back(x[2] < 1e-9 ? Support::fixed : Support::free);
  Forces weights = Forces::Zero(Eigen::Index(3 * m.mesh.nodes.size()));
  for (const auto& element : m.mesh.elements)
    if (m.mesh.nodes[size_t(element[6])][0] < 0.015 + 1e-9)
      for (const int a : element) weights[3 * a] += 1;
  weights /= weights.sum();
  m.tissue_mass = tissue_mass(m.mesh, 1040);
  const auto tissue = std::make_shared<Elasticity>(m.mesh, TissueConstants{192, 90, 191872});
  m.effects = {tissue, std::make_shared<DeadLoad>("load", weights, 1.0),
               std::make_shared<Viscosity>(m.tissue_mass, tissue, 40, 0.03)};
  m.finish();
  return m;
}

int top_centre(int split) {
  const int nx = 12 * split, ny = 8 * split, nz = 10 * split;
  return (nz * (ny + 1) + ny / 2) * (nx + 1) + nx / 2;
}

}  // namespace genio::bench
