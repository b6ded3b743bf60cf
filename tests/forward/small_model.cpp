#include "tests/forward/small_model.hpp"

#include <cmath>
#include <filesystem>
#include <random>

#include "forward/geometry/box_mesh.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/effect_kinds.hpp"

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

std::vector<NamedField> test_modes() {
  return {{"size", [](const Vec3& x) -> Vec3 { return 0.05 * (x - Vec3(0.02, 0.005, 0)); }},
          {"depth", [](const Vec3& x) -> Vec3 {
             return {1.5e-3 * std::tanh(60 * x[0]), 0, 4e-4 * std::sin(90 * x[0])};
           }}};
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
  d = with_modes(std::move(d), test_modes());
  d.effects.clear();
  for (const EffectKind& kind : effect_kinds())
    if (!kind.always) d.effects[kind.name] = kind.sample;
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
