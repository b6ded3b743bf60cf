// The slow part of the verification: tables that docs/verification.md shows.

#include "bench/figures/forward/verification.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/problems/block.hpp"
#include "bench/problems/manufactured.hpp"
#include "bench/problems/problems.hpp"
#include "bench/problems/sphere.hpp"
#include "forward/anatomy/import_grenoble.hpp"
#include "forward/anatomy/refine.hpp"
#include "forward/effects/surroundings/gravity.hpp"
#include "forward/motion/dynamics.hpp"
#include "report/discovery/verification_report.hpp"

namespace genio::bench {
namespace {

Json manufactured_table(const Progress& progress) {
  Json rows = Json::array();
  for (const double nu : {0.3, 0.499, 0.4999})
    for (const double distortion : {0.0, 0.15}) {
      double before = 0;
      for (const int n : {4, 8, 16}) {
        const double error = manufactured_error(n, nu, distortion);
        const double rate = before > 0 ? std::log2(before / error) : 0;
        progress(fmt::format(
            "manufactured  nu {:<6} distortion {:<4} n {:>2}: L2 error {:.3e}, rate {:.2f}", nu,
            distortion, n, error, rate));
        rows.push_back({{"poisson_ratio", nu},
                        {"distortion", distortion},
                        {"n", n},
                        {"relative_l2_error", error},
                        {"rate", rate}});
        before = error;
      }
    }
  return rows;
}

Json cook_table(const Progress& progress) {
  Json rows = Json::array();
  for (const double nu : {0.3, 0.49, 0.499, 0.4999})
    for (const int n : {2, 4, 8, 16, 32}) {
      const double rise = 1e3 * cook_corner(n, nu);
      progress(fmt::format("Cook          nu {:<6} n {:>2}: corner rises {:.3f} mm", nu, n, rise));
      rows.push_back({{"poisson_ratio", nu}, {"n", n}, {"corner_mm", rise}});
    }
  return rows;
}

Json sphere_table(const Progress& progress) {
  Json rows = Json::array();
  for (const int n : {4, 8, 12}) {
    const double ratio = sphere_pressure_ratio(n, n, 1.5);
    progress(fmt::format("sphere        n {:>2}: pressure over the exact one {:.4f}", n, ratio));
    rows.push_back({{"n", n}, {"pressure_ratio", ratio}});
  }
  return rows;
}

/// End of the block's motion under half a sine of load, against a step of 1/8 ms.
Json time_table(const Progress& progress) {
  Json rows = Json::array();
  const Model m = block({4, 2, 4});
  CommandsOverTime load;
  for (int i = 0; i <= 320; ++i) {
    Parameters p = default_parameters(m);
    p[parameter_index(m, "load.force")] = 0.2 * std::pow(std::sin(M_PI * i / 320), 4);
    load.times.push_back(1.25e-4 * i), load.values.push_back(p);
  }
  for (const auto& [name, by] : {std::pair{"newmark", TimeScheme::newmark()},
                                 {"generalised-alpha 0.5", TimeScheme::generalised_alpha(0.5)}}) {
    const auto end = [&, scheme = by](double step) {
      TimeOptions o;
      o.duration = 0.04, o.step = step, o.scheme = scheme, o.tolerance = 1e-7;
      Workspace ws(m);
      const Trajectory t = simulate(m, load, m.rest, ws, o);
      if (!t) throw std::runtime_error("the verification's motion ended early: " + t.message);
      return t.instants.back().x;
    };
    const Positions exact = end(6.25e-5);
    double before = 0;
    for (const double step : {4e-3, 2e-3, 1e-3, 5e-4}) {
      const double error = (end(step) - exact).norm() / (exact - m.rest).norm();
      const double rate = before > 0 ? std::log2(before / error) : 0;
      progress(fmt::format("time          {:<22} step {:.1f} ms: error {:.3e}, rate {:.2f}", name,
                           1e3 * step, error, rate));
      rows.push_back(
          {{"scheme", name}, {"step_ms", 1e3 * step}, {"relative_error", error}, {"rate", rate}});
      before = error;
    }
  }
  return rows;
}

std::string millimetres(const Vec3& u) {
  return fmt::format("{:7.3f} {:7.3f} {:7.3f} mm", 1e3 * u[0], 1e3 * u[1], 1e3 * u[2]);
}

Json row(const std::string& code, size_t elements, const Vec3& u, const Progress& progress,
         const std::string& what) {
  progress(fmt::format("{:<13} {:<18} {:>6} elements: {}", what, code, elements, millimetres(u)));
  return {{"code", code}, {"elements", elements}, {"mm", {1e3 * u[0], 1e3 * u[1], 1e3 * u[2]}}};
}

/// Top centre of the block under 1 N, by mesh and code.
Json block_table(const Progress& progress) {
  Json rows = Json::array();
  for (const std::array<int, 3>& n : {std::array{4, 4, 4}, {8, 6, 6}, {12, 8, 10}, {24, 16, 20}}) {
    const Model m = block(n);
    const int top = (n[2] * (n[1] + 1) + n[1] / 2) * (n[0] + 1) + n[0] / 2;
    const auto moved = [&](const Positions& x) {
      return Vec3(node_position(x, top) - node_position(m.rest, top));
    };
    Workspace ws(m);
    const Equilibrium e = solve_equilibrium(m, default_parameters(m), m.rest, ws);
    if (e)
      rows.push_back(row("Genio Q1-P0", m.mesh.elements.size(), moved(e.x), progress, "block"));
    CalculixProblem p = block_for_calculix(m, 1.0);
    for (const auto& [name, element, most] :
         {std::tuple{"CalculiX C3D8", CalculixElement::c3d8, 1000u},
          {"CalculiX C3D20R", CalculixElement::c3d20r, 300u}}) {
      p.element = element;
      if (m.mesh.elements.size() > most) continue;
      if (const auto peer = run_calculix(p); peer && peer->complete)
        rows.push_back(row(name, m.mesh.elements.size(), moved(peer->x), progress, "block"));
    }
  }
  return rows;
}

/// The Grenoble tongue sagging under its weight, living constants, by mesh and code.
Json tongue_table(const std::string& folder, const Progress& progress) {
  Json rows = Json::array();
  const ModelDescription d = import_grenoble(folder);
  const TissueConstants c{1037, 486, 1037000};
  const Vec3 weight(0, 0, -9.81 * d.density);
  HexMesh mesh = d.mesh;
  std::vector<Support> supports = d.supports;
  for (int level = 0; level < 2; ++level) {
    ModelParts parts = tissue_problem(mesh, supports, c).parts();
    parts.effects.push_back(
        {.potential = std::make_shared<Gravity>(tissue_mass(mesh, d.density), Vec3(0, 0, -9.81))});
    const Model m(std::move(parts));
    const auto moved = [&](const Positions& x) {
      return Vec3(node_position(x, d.landmarks.tip) - node_position(m.rest, d.landmarks.tip));
    };
    Workspace ws(m);
    const Equilibrium e = solve_equilibrium(m, default_parameters(m), m.rest, ws);
    if (e)
      rows.push_back(row("Genio Q1-P0", mesh.elements.size(), moved(e.x), progress, "tongue tip"));
    else progress("tongue: " + e.message);
    CalculixProblem p{mesh, supports, c, {}, weight};
    for (int i = 0; i < int(mesh.elements.size()); ++i) p.loaded.push_back(i);
    for (const auto& [name, element, levels] :
         {std::tuple{"CalculiX C3D8", CalculixElement::c3d8, 1},
          {"CalculiX C3D20R", CalculixElement::c3d20r, 1}}) {
      p.element = element;
      if (level >= levels) continue;
      const auto peer = run_calculix(p);
      if (peer && peer->complete)
        rows.push_back(row(name, mesh.elements.size(), moved(peer->x), progress, "tongue tip"));
      else if (peer) progress(fmt::format("tongue: {} did not converge", name));
    }
    RefinedMesh finer = refined(mesh, supports);
    mesh = std::move(finer.mesh), supports = std::move(finer.supports);
  }
  return rows;
}

Json run_verification(const BenchOptions& o, const Progress& progress) {
  Json j;
  j["manufactured"] = manufactured_table(progress);
  j["cook"] = cook_table(progress);
  j["sphere"] = sphere_table(progress);
  j["time"] = time_table(progress);
  j["block"] = block_table(progress);
  if (!o.data.empty()) j["tongue"] = tongue_table(o.data, progress);
  if (!o.out.empty()) write_verification(j, o.out);
  return j;
}

}  // namespace

Benchmark verification_bench() {
  return {.name = "verification",
          .about = "The tables of docs/verification.md: order in space and time, CalculiX by mesh",
          .options = {{"--data", "folder of the ANSYS files"},
                      {"--out", "folder for its tables and plots"}},
          .run = run_verification};
}

}  // namespace genio::bench
