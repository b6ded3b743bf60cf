#include "tests/forward/small_model.hpp"

#include <filesystem>
#include <random>

#include "forward/geometry/box_mesh.hpp"
#include "forward/model/build_model.hpp"

namespace genio::test {

ModelDescription small_block() {
  ModelDescription d;
  d.name = "block";
  const int nx = 3, ny = 2, nz = 2;
  const auto node = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  std::mt19937 bits(7);
  const auto jitter = [&] { return 1.2e-3 * (double(bits()) / 4294967296.0 - 0.5); };
  d.mesh = box_mesh(5e-3 * Vec3(nx, ny, nz), {nx, ny, nz});
  for (Vec3& x : d.mesh.nodes) {
    d.supports.push_back(x[2] > 1e-9    ? Support::free
                         : x[0] > 14e-3 ? Support::horizontal
                                        : Support::fixed);
    for (int i = 0; i < 3; ++i) x[i] += jitter();
  }
  Muscle along{
      "GGP_L",
      2,
      {{{node(0, 1, 2), {}}, {node(1, 1, 2), {}}, {node(2, 1, 1), {}}, {node(3, 1, 1), {}}}},
      {},
      {}};
  Muscle up{"GGP_R",
            2,
            {{{node(1, 0, 0), {}}, {node(1, 0, 1), {}}, {node(1, 1, 2), {}}},
             {{-1, Vec3(0.03, 0.01, 0.03)}, {node(3, 2, 2), {}}}},
            {},
            {}};
  for (int e = 0; e < int(d.mesh.elements.size()); ++e)
    along.elements.push_back(e), up.elements.push_back(e);
  d.muscles = {along, up};
  d.landmarks = {node(0, 1, 2), node(1, 1, 2), node(3, 1, 2)};
  d.midsagittal = {node(0, 1, 1), node(0, 1, 2), node(1, 1, 2), node(2, 1, 2), node(3, 1, 2)};
  TriangleSurface palate;  // a tilted plane just above
  palate.vertices = {
      {-0.01, -0.01, 0.0108}, {0.03, -0.01, 0.0112}, {0.03, 0.02, 0.0114}, {-0.01, 0.02, 0.011}};
  palate.triangles = {{0, 1, 2}, {0, 2, 3}};
  d.palate = palate;
  d.effects["elasticity"] = {{"a10", 192}, {"a20", 90}, {"kappa", 19200}};
  d.effects["gravity"] = {{"x", 1}, {"y", 0.5}, {"z", -9.81}, {"pitch", 20}};
  d.effects["palate_contact"] = {{"stiffness", 1e7}};
  return d;
}

ModelDescription with_every_effect() {
  ModelDescription d = small_block();
  TriangleSurface jaw;  // a tilted plane just in front
  jaw.vertices = {{-0.0014, -0.01, -0.01},
                  {-0.0012, 0.03, -0.01},
                  {-0.001, 0.03, 0.03},
                  {-0.0012, -0.01, 0.03}};
  jaw.triangles = {{0, 1, 2}, {0, 2, 3}};
  d.jaw = jaw;
  d.effects["palate_contact"]["damping"] = 8;
  d.effects["jaw_contact"] = {{"stiffness", 2e7}, {"damping", 5}};
  d.effects["active_stiffening"] = {{"factor", 6}};
  d.effects["fibre_anisotropy"] = {{"modulus", 900}};
  d.effects["material_nonlinearity"] = {{"a20", 30}, {"a30", 50}};
  d.effects["compressibility"] = {{"compliance", 2e-5}};
  d.effects["mucosa_layer"] = {{"a10", 500}, {"a20", 300}};
  d.effects["stiff_region"] = {
      {"factor", 3}, {"x", 0.006}, {"y", 0.004}, {"z", 0.006}, {"radius", 0.007}};
  d.effects["weak_muscle"] = {{"GGP_L", 0.3}, {"GGP_R", 0.6}};
  d.effects["extra_muscle"] = {{"from_x", 0.001}, {"from_y", 0.005}, {"from_z", 0.008},
                               {"to_x", 0.014},   {"to_y", 0.005},   {"to_z", 0.004},
                               {"radius", 0.004}, {"force", 0.3}};
  d.effects["force_length"] = {{"strength", 0.7}, {"width", 0.5}, {"optimum", 1.1}};
  d.effects["force_velocity"] = {{"strength", 0.8}, {"max_velocity", 4}};
  d.effects["activation_dynamics"] = {};
  d.effects["jaw_opening"] = {{"angle", 3}, {"slide", 4e-4}, {"hinge_x", 0.05}, {"hinge_z", 0.02}};
  d.effects["hyoid_mobility"] = {{"compliance_z", 1e-3}, {"stiffness_xy", 100}};
  d.effects["airway_pressure"] = {{"pressure", 300}};
  d.effects["viscosity"] = {};
  return d;
}

Model small_model() { return build_model(small_block(), "block"); }

std::string generic_model() { return GENIO_SOURCE_DIR "/data/generic"; }

std::string reference_folder() {
  const std::string folder = GENIO_SOURCE_DIR "/../shared/reference";
  return std::filesystem::is_directory(folder) ? folder : "";
}

Positions shaken(const Model& model, double size, unsigned seed) {
  std::mt19937 bits(seed);
  Positions x = model.rest;
  for (auto& v : x) v += size * (2 * double(bits()) / 4294967296.0 - 1);
  return x;
}

}  // namespace genio::test
