#include "bench/experiments/grenoble_gravity.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/problems/calculix.hpp"
#include "bench/problems/measure.hpp"
#include "discrepancy/contest/discover.hpp"
#include "forward/anatomy/import_grenoble.hpp"
#include "forward/model/build_model.hpp"
#include "report/discovery/discovery_report.hpp"

namespace genio::bench {
namespace {

constexpr double noise_sd = 0.4e-3, correlation = 8e-3;  // [m]
constexpr double told_error = 0.1;
constexpr double gravity = 9.81;  // downwards [m/s^2]
constexpr int points_along = 32, points_across = 20;
constexpr int rounds = 2;  // of muscle forces and shapes in turn

using Posture = std::map<std::string, double>;  // of both sides together [N]

const std::vector<Posture>& postures() {
  static const std::vector<Posture> all = {
      {}, {{"GGP", 0.4}}, {{"STY", 0.2}}, {{"HG", 0.2}}, {{"GGA", 0.3}}, {{"GGM", 0.3}}};
  return all;
}
constexpr size_t heldout = 1;  // the last one

/// Nodal forces of the muscles alone.
std::vector<Vec3> muscle_forces(const Model& m, const Positions& x, const Parameters& p) {
  const Forces f = forces_of(m, x, p, [](const Effect& e) { return e.commands; });
  std::vector<Vec3> nodal;
  for (size_t a = 0; a < m.mesh.nodes.size(); ++a) nodal.push_back(node_position(f, int(a)));
  return nodal;
}

/// The shape that CalculiX gives to a posture under gravity: muscles pull along their fibres, so
/// their forces follow the shape, found in turn with it. Nothing where ccx fails.
std::optional<Positions> shape(const Model& heavy, const Posture& posture) {
  Workspace ws(heavy);
  Parameters p = default_parameters(heavy);
  for (const auto& [name, f] : posture) set_command(heavy, name, f, p);
  const Equilibrium near = solve_equilibrium(heavy, p, heavy.rest, ws);
  if (!near) return {};
  const auto value = [&](const char* name) { return p[parameter_index(heavy, name)]; };
  CalculixProblem problem{
      heavy.mesh,
      heavy.supports,
      {value("elasticity.a10"), value("elasticity.a20"), value("elasticity.kappa")},
      {},
      heavy.description->density * gravity * -Vec3::UnitZ(),
      CalculixElement::c3d20r};
  problem.density = heavy.description->density;
  for (size_t e = 0; e < heavy.mesh.elements.size(); ++e) problem.loaded.push_back(int(e));
  Positions x = near.x;
  for (int round = 0; round < rounds; ++round) {
    problem.nodal = muscle_forces(heavy, x, p);
    const auto result = run_calculix(problem);
    if (!result || !result->complete) return {};
    const double change = (result->x - x).cwiseAbs().maxCoeff();
    x = result->x;
    if (round > 0 && change < 5e-5) break;
  }
  return x;
}

Json run_grenoble_gravity(const BenchOptions& asked, const Progress& progress) {
  const std::string& folder = asked.data;
  ModelDescription light = import_grenoble(folder);
  for (const char* contact : {"palate_contact", "jaw_contact", "gravity"})
    light.effects.erase(contact);
  ModelDescription with = light;
  with.effects["gravity"] = {{"x", 0}, {"y", 0}, {"z", -gravity}};
  const Model heavy = build_model(with, folder), model = build_model(light, folder);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Observations o;
  o.noise = noise_sd, o.noise_correlation = correlation;
  for (size_t k = 0; k < postures().size(); ++k) {
    const auto x = shape(heavy, postures()[k]);
    if (!x) return {{"failed", "ccx is not installed or did not converge"}};
    if (progress) progress(fmt::format("posture {} of {} by CalculiX", k + 1, postures().size()));
    auto points = contours_of(heavy, *x, points_along, points_across);
    add_noise(points, noise_sd, correlation, random);
    Condition c;
    c.name = fmt::format("posture {}", k + 1), c.heldout = k + heldout >= postures().size();
    c.target = target_of(points, noise_sd);
    c.forces.emplace();
    for (const auto& [name, f] : postures()[k])
      for (int i : command_parameters(model, name)) {
        const auto& info = model.parameters[size_t(i)].info;
        Parameters p = default_parameters(model);
        set_command(model, name, f, p);
        const double told = std::clamp(p[i] * (1 + told_error * normal(random)), 0.0, info.upper);
        (*c.forces)[info.name] = {told, told_error * told};
      }
    o.conditions.push_back(std::move(c));
  }
  DiscoverOptions options;
  options.progress = progress;
  return to_json(discover(light, o, options), o, "");
}

}  // namespace

Benchmark grenoble_gravity_bench() {
  return {.name = "grenoble-gravity",
          .about = "What discovery says of Grenoble postures that CalculiX made with gravity",
          .options = {{"--data", "folder of the ANSYS files", true}},
          .run = run_grenoble_gravity};
}

}  // namespace genio::bench
