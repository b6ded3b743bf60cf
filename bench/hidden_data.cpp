#include "bench/hidden_data.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "bench/measure.hpp"
#include "bench/random_muscles.hpp"
#include "bench/truth.hpp"
#include "forward/half_model.hpp"
#include "forward/refine.hpp"
#include "forward/sensitivity.hpp"
#include "inverse/curvature.hpp"
#include "inverse/moved_target.hpp"

namespace genio::bench {
namespace {

namespace fs = std::filesystem;

constexpr double fibre_turn = 5;     // [degrees]
constexpr double largest = 0.15;     // of a muscle's maximum
constexpr double force_error = 0.1;  // of known forces
constexpr int most_tries = 5;
constexpr double effort_sd = 0.12;
constexpr int most_refits = 6;
constexpr int line_points = 32, across_points = 20, scattered_points = 90;

using Forces_N = std::map<std::string, double>;  // of both sides together

std::vector<Forces_N> postures(const std::vector<Command>& muscles, int count,
                               std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Forces_N> result;
  for (int k = 0; k < count; ++k) {
    Forces_N f;
    for (int i : some_muscles(muscles.size(), random, uniform))
      f[muscles[size_t(i)].name] = largest * uniform(random) * muscles[size_t(i)].scale;
    result.push_back(std::move(f));
  }
  return result;
}

std::vector<std::string> most_used(const std::vector<Forces_N>& all, const ModelDescription& d) {
  std::map<std::string, double> use;
  for (const auto& f : all)
    for (const auto& [name, force] : f)
      for (const Muscle& m : d.muscles)
        if (bilateral_name(m.name) == name) use[name] += force / m.max_force;
  std::vector<std::string> names;
  for (const auto& [name, u] : use) names.push_back(name);
  std::sort(names.begin(), names.end(),
            [&](const auto& a, const auto& b) { return use[a] > use[b]; });
  return names;
}

Parameters commanded(const Model& m, const Forces_N& forces, bool half = false) {
  Parameters p = default_parameters(m);
  for (const auto& [name, f] : forces) set_command(m, name, half ? 0.5 * f : f, p);
  return p;
}

/// With fibres turned; another draw where one would turn an element inside out.
ModelDescription turned(const ModelDescription& tongue, unsigned seed) {
  for (unsigned tries = 0; tries < 20; ++tries) {
    const ModelDescription d = with_turned_fibres(tongue, fibre_turn, seed + 100000 * tries);
    try {
      check_mesh(refined(d).mesh, "truth");
      return d;
    } catch (const InputError&) {
    }
  }
  throw std::runtime_error("no draw of turned fibres leaves the mesh valid");
}

struct Changes {
  std::vector<HiddenChange> all;
  std::vector<double> s;

  ModelDescription truth(ModelDescription d) const {
    for (size_t i = 0; i < all.size(); ++i) d = all[i].truth(std::move(d), s[i]);
    return d;
  }
  ModelDescription shipped(ModelDescription d) const {
    for (size_t i = 0; i < all.size(); ++i) d = all[i].shipped(std::move(d), s[i]);
    return d;
  }
  void by_hand(Model& m) const {
    for (size_t i = 0; i < all.size(); ++i)
      if (all[i].by_hand) all[i].by_hand(m, s[i]);
  }
  HeadPose pose() const {
    HeadPose p;
    for (size_t i = 0; i < all.size(); ++i)
      if (all[i].pose) p = all[i].pose(s[i]);
    return p;
  }
  bool symmetric() const {
    return std::all_of(all.begin(), all.end(), [](const auto& c) { return c.symmetric; });
  }
};

void lay(std::vector<Measured>& points, const HeadPose& pose) {
  Vec2 middle = Vec2::Zero();
  for (const auto& p : points) middle += Vec2(p.position[0], p.position[2]) / double(points.size());
  const MovedTarget moved(pose, middle);
  for (auto& p : points) p.position = moved(p.position);
}

Target target_of(const std::vector<Measured>& points, double sigma) {
  Target t;
  for (const auto& p : points)
    if (p.kind == "curve") t.curve.push_back({Vec2(p.position[0], p.position[2]), sigma});
    else t.surface.push_back({p.position, sigma, p.slice});
  return t;
}

/// The least squares step |r + J d|^2 + |(z + d - mean) / sd|^2 with z + d >= 0: what would go
/// below stays at 0.
Vector bounded_step(const Vector& r, const Matrix& j, const Vector& z, const Vector& mean,
                    const Vector& sd) {
  const auto n = z.size();
  std::vector<bool> at_zero(size_t(n), false);
  Vector d = Vector::Zero(n);
  for (bool again = true; again;) {
    std::vector<Eigen::Index> free;
    d = -z;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!at_zero[size_t(i)]) free.push_back(i), d[i] = 0;
    if (free.empty()) break;
    const Matrix a = j(Eigen::all, free);
    const Vector weight = sd(free).cwiseAbs2().cwiseInverse();
    const Matrix h = a.transpose() * a + Matrix(weight.asDiagonal());
    const Vector g = a.transpose() * (r + j * d) + weight.cwiseProduct(z(free) - mean(free));
    d(free) = -h.llt().solve(g);
    again = false;
    for (Eigen::Index i : free)
      if (z[i] + d[i] < 0) again = at_zero[size_t(i)] = true;
  }
  return d;
}

/// A posture's residuals after its forces were refitted to `target`, from those it was made with;
/// empty where there is no equilibrium.
Vector after_refit(const Model& m, Equilibrium e, const Target& target, bool known, Workspace& ws) {
  const Comparison comparison(m, target);
  const auto commands = muscle_commands(m, !known);
  const auto n = Eigen::Index(commands.size());
  Vector z(n), sd = Vector::Constant(n, effort_sd), mean = Vector::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Command& c = commands[size_t(i)];
    z[i] = 0;
    for (int k : c.parameters) z[i] += e.parameters[k] / c.scale;
  }
  if (known) mean = z, sd = (force_error * z).cwiseMax(1e-6);
  Residuals r = comparison(e.x);
  for (int step = 0; step < most_refits; ++step) {
    const Matrix j = residual_jacobian(
        r, sensitivity_to_forces(m, e, command_pulls(m, commands, e.x, e.parameters), ws));
    const Vector d = bounded_step(r.values, j, z, mean, sd);
    const auto cost = [&](const Vector& values, const Vector& at) {
      return values.squaredNorm() + (at - mean).cwiseQuotient(sd).squaredNorm();
    };
    const double before = cost(r.values, z);
    bool better = false;
    for (double part = 1; part > 0.1 && !better; part *= 0.5) {
      const Vector next = z + part * d;
      const Equilibrium there =
          solve_equilibrium(m, apply_commands(commands, next, default_parameters(m)), e.x, ws);
      if (!there) continue;
      const Residuals at_next = comparison(there.x);
      if (cost(at_next.values, next) > before) continue;
      better = true, z = next, e = there, r = at_next;
    }
    if (!better || before - cost(r.values, z) < 0.01 * before) break;
  }
  return r.values;
}

/// What is left of the change's marks on the data once the forces have done their best, in units of
/// the noise (root mean square over points and conditions); on the coarse mesh. Negative: no
/// equilibrium.
double excess(const ModelDescription& tongue, const Changes& changes,
              const std::vector<Forces_N>& all, const HiddenCase& what) {
  const Model without = build_model(changes.shipped(tongue), "shipped");
  Model with = build_model(changes.truth(tongue), "truth");
  changes.by_hand(with);
  Workspace ws(without), ws_with(with);
  double sum = 0, count = 0;
  std::mt19937 random(1);
  for (const auto& forces : all) {
    const Equilibrium a = solve_equilibrium(without, commanded(without, forces), without.rest, ws);
    const Equilibrium b = solve_equilibrium(with, commanded(with, forces), a.x, ws_with);
    if (!a || !b) return -1;
    auto points = what.surface ? surface_of(with, b.x, scattered_points, random)
                               : contours_of(with, b.x, line_points, across_points);
    lay(points, changes.pose());
    const Vector left =
        after_refit(without, a, target_of(points, what.noise), what.forces_known, ws);
    sum += left.squaredNorm(), count += double(left.size());
  }
  return std::sqrt(sum / count);
}

/// The amplitude that gives the strength asked for; false where it is out of reach.
bool find_amplitude(const ModelDescription& tongue, const HiddenChange& change,
                    const std::vector<Forces_N>& fitted, const HiddenCase& what, double strength,
                    double& s) {
  double low = 0, high = -1, at_low = 0;
  s = change.first;
  for (int i = 0; i < 12; ++i) {
    const double e = excess(tongue, {{change}, {s}}, fitted, what);
    if (e >= 0 && std::abs(e - strength) < 0.05 * strength) return true;
    if (e < 0 || e > strength) {
      high = s;
    } else {
      low = s, at_low = e;
    }
    if (high < 0) {
      if (s >= change.most) return false;
      s = std::min(change.most,
                   at_low > 0 ? std::clamp(s * strength / at_low, 1.3 * s, 4 * s) : 3 * s);
    } else {
      s = e > 0 && e > strength
              ? std::clamp(s * strength / e, low + 0.1 * (high - low), low + 0.9 * (high - low))
              : 0.5 * (low + high);
    }
  }
  return false;
}

/// The shape of the fine tongue, from the coarse one's.
Equilibrium fine_shape(const Model& fine, const Model& coarse, const Forces_N& forces, bool half,
                       Workspace& ws_coarse, Workspace& ws) {
  const Equilibrium rough =
      solve_equilibrium(coarse, commanded(coarse, forces, half), coarse.rest, ws_coarse);
  if (!rough) return rough;
  const Positions start = prolonged(coarse.mesh, coarse.description->supports, rough.x);
  SolveOptions options;
  options.tolerance = 1e-7;
  return solve_equilibrium(fine, commanded(fine, forces, half), start, ws, options);
}

void write_target(const std::string& path, const std::vector<Measured>& points) {
  std::ofstream out(path);
  out << "frame,point,x_mm,y_mm,z_mm,kind,slice\n";
  int k = 0;
  for (const auto& p : points)
    out << fmt::format("1,{},{:.4f},{:.4f},{:.4f},{},{}\n", ++k, 1e3 * p.position[0],
                       1e3 * p.position[1], 1e3 * p.position[2], p.kind, p.slice);
}

}  // namespace

Json make_hidden_data(const ModelDescription& tongue, const HiddenCase& what,
                      const std::string& folder, const std::string& answer) {
  std::mt19937 random(what.seed);
  const auto all = postures(muscle_commands(build_model(tongue, tongue.name), true),
                            what.fitted + what.heldout, random);
  const std::vector<Forces_N> fitted(all.begin(), all.begin() + what.fitted);
  const auto failed = [&](const std::string& why) {
    const Json j = {{"case", what.name}, {"failed", why}};
    std::ofstream(answer) << j.dump(1) << "\n";
    return j;
  };
  Changes changes;
  for (const std::string& name : what.effects) {
    HiddenChange c;
    double s = 0;
    bool found = false;
    for (int tries = 0; tries < most_tries && !found; ++tries) {  // at one place or another
      c = hidden_change(name, tongue, most_used(fitted, tongue), what.forces_known, random);
      found = find_amplitude(tongue, c, fitted, what, what.strength, s);
    }
    if (!found) return failed(fmt::format("{}: strength {} is out of reach", name, what.strength));
    changes.all.push_back(c), changes.s.push_back(s);
  }
  ModelDescription coarse = changes.truth(turned(tongue, what.seed));
  const bool half = changes.symmetric();
  if (half) coarse = half_of(coarse, "truth");
  Model rough = build_model(coarse, "truth"), fine = build_model(refined(coarse), "fine truth");
  changes.by_hand(rough), changes.by_hand(fine);
  Workspace ws_rough(rough), ws(fine);
  fs::create_directories(folder);
  std::mt19937 noise(what.noise_seed * 7919 + what.seed);
  std::normal_distribution<double> normal;
  std::string toml = fmt::format("noise_mm = {}\nnoise_correlation_mm = {}\n", 1e3 * what.noise,
                                 1e3 * what.correlation);
  if (what.forces_known) toml += fmt::format("force_sd_percent = {}\n", 100 * force_error);
  for (size_t k = 0; k < all.size(); ++k) {
    const Equilibrium e = fine_shape(fine, rough, all[k], half, ws_rough, ws);
    if (!e) return failed("truth: " + e.message);
    auto points = what.surface ? surface_of(fine, e.x, scattered_points, noise)
                               : contours_of(fine, e.x, line_points, across_points);
    lay(points, changes.pose());
    add_noise(points, what.noise, what.correlation, noise);
    const std::string name = fmt::format("posture{}", k + 1);
    write_target(folder + "/" + name + ".csv", points);
    toml += fmt::format("\n[[condition]]\nname = \"{}\"\ntarget = \"{}.csv\"\nheldout = {}\n", name,
                        name, k >= size_t(what.fitted));
    if (!what.forces_known) continue;
    std::vector<std::string> entries;
    for (const Muscle& m : tongue.muscles) {
      const auto f = all[k].find(bilateral_name(m.name));
      if (f == all[k].end()) continue;
      const double share = bilateral_name(m.name) == m.name ? 1.0 : 0.5;
      const double told = share * f->second * (1 + force_error * normal(noise));
      entries.push_back(fmt::format("{} = {:.5f}", m.name, std::clamp(told, 0.0, m.max_force)));
    }
    toml += fmt::format("forces_N = {{ {} }}\n", fmt::join(entries, ", "));
  }
  std::ofstream(folder + "/observations.toml") << toml;
  ModelDescription shipped = changes.shipped(tongue);
  shipped.name = "Tongue of " + what.name;
  write_description(shipped, folder + "/model");
  Json hidden = Json::array();
  for (size_t i = 0; i < changes.all.size(); ++i)
    hidden.push_back({{"effect", changes.all[i].effect},
                      {"where", changes.all[i].where},
                      {"in_library", changes.all[i].in_library},
                      {"amplitude", changes.s[i]},
                      {"parameters", changes.all[i].parameters(changes.s[i])}});
  const Json j = {{"case", what.name},
                  {"hidden", hidden},
                  {"strength", what.strength},
                  {"forces_known", what.forces_known},
                  {"surface", what.surface}};
  std::ofstream(answer) << j.dump(1) << "\n";
  return j;
}

}  // namespace genio::bench
