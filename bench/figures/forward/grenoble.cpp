#include "bench/figures/forward/grenoble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/problems/clock.hpp"
#include "forward/anatomy/import_grenoble.hpp"
#include "forward/model/build_model.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio::bench {
namespace {

/// Landmarks of the independent static solution, 0-based nodes.
constexpr int tip = 919, dorsum = 869, base = 927;

struct Case {
  const char *law, *muscle;
  double newtons, a10, a20;
  double expected[6];  // (dx, dz) of tip, dorsum, base [mm]
  double largest;      // displacement of any node [mm]
  const char* paper;   // what Gerard, Perrier & Payan, section 5.3, print with contact
};

constexpr Case cases[] = {
    {"cadaver",
     "GGP",
     4,
     192,
     90,
     {-10.10, -18.62, -20.24, -1.43, -17.25, 1.73},
     21.47,
     "rear 20 mm forward, dorsum 9 mm up"},
    {"cadaver",
     "HG",
     2,
     192,
     90,
     {18.36, 14.15, 19.15, -6.12, 10.20, -11.67},
     23.2,
     "rear 12 mm down and back"},
    {"living", "GGP", 4, 1037, 486, {-4.22, -5.45, -6.51, 0.80, -6.87, 0.08}, 7.65, nullptr},
    {"living", "HG", 2, 1037, 486, {6.42, 6.86, 8.17, -1.33, 4.21, -4.20}, 9.4, nullptr}};

Equilibrium solve(const Model& m, const Case& c) {
  Parameters p = default_parameters(m);
  set_parameter(m, "elasticity.a10", c.a10, p);
  set_parameter(m, "elasticity.a20", c.a20, p);
  set_parameter(m, "elasticity.kappa", 1000 * c.a10, p);
  set_command(m, c.muscle, c.newtons, p);
  Workspace ws(m);
  return solve_equilibrium(m, p, m.rest, ws);
}

Json describe(const Model& m, const Case& c, bool contact, const Progress& progress) {
  Equilibrium e;
  const double wall = seconds([&] { e = solve(m, c); });
  Json j = {{"law", c.law},
            {"muscle", c.muscle},
            {"force_N", c.newtons},
            {"contact", contact},
            {"status", e ? "converged" : "failed"},
            {"message", e.message},
            {"factorizations", e.factorizations},
            {"wall_s", wall}};
  std::string line = fmt::format("{:<8} {:<4} {} N contact {:<4}", c.law, c.muscle, c.newtons,
                                 contact ? "on" : "off");
  if (e) {
    const Vector u = 1e3 * (e.x - m.rest);
    double off = 0;
    const char* names[] = {"tip", "dorsum", "base"};
    const int nodes[] = {tip, dorsum, base};
    for (int i = 0; i < 3; ++i) {
      const double dx = u[3 * nodes[i]], dz = u[3 * nodes[i] + 2];
      off = std::max({off, std::abs(dx - c.expected[2 * i]), std::abs(dz - c.expected[2 * i + 1])});
      j["landmarks"][names[i]] = {{"dx_mm", dx}, {"dz_mm", dz}};
      line += fmt::format("  {} {:6.2f} {:6.2f}", names[i], dx, dz);
    }
    // Of the midsagittal line: its rear, from the dorsum down, and its rise.
    double forward = 0, down = 0, up = 0;
    bool rear = false;
    for (const int n : m.midsagittal) {
      rear |= n == dorsum;
      up = std::max(up, u[3 * n + 2]);
      if (rear) forward = std::max(forward, -u[3 * n]), down = std::max(down, -u[3 * n + 2]);
    }
    j["rear_forward_max_mm"] = forward, j["rear_down_max_mm"] = down, j["up_max_mm"] = up;
    j["max_penetration_mm"] = 1e3 * max_penetration(m, e.x, e.parameters);
    line += fmt::format("  rear forward {:.1f}, down {:.1f}; up {:.1f}", forward, down, up);
    if (!contact) {
      j["deviation_mm"] = off, j["deviation_percent"] = 100 * off / c.largest;
      line += fmt::format("  off by {:.3f} mm = {:.2f} %", off, 100 * off / c.largest);
    }
    if (contact && c.paper) j["paper"] = c.paper, line += fmt::format("  (paper: {})", c.paper);
  } else {
    line += "  " + e.message;
  }
  if (progress)
    progress(line + fmt::format("  {:.2f} s, {} factorisations", j["wall_s"].get<double>(),
                                e.factorizations));
  return j;
}

Json run_grenoble(const BenchOptions& o, const Progress& progress) {
  const std::string& folder = o.data;
  ModelDescription d = import_grenoble(folder);
  const Model with = build_model(d, folder);
  d.effects.erase("palate_contact");
  d.effects.erase("jaw_contact");
  const Model without = build_model(d, folder);
  Json rows = Json::array();
  for (const Case& c : cases) rows.push_back(describe(without, c, false, progress));
  for (const Case& c : cases) rows.push_back(describe(with, c, true, progress));
  return {{"cases", rows}};
}

}  // namespace

Benchmark grenoble_bench() {
  return {.name = "grenoble",
          .about = "The Grenoble tongue under GGP and HG, beside an independent solution",
          .options = {{"--data", "folder of the ANSYS files", true}},
          .run = run_grenoble};
}

}  // namespace genio::bench
