#include "bench/experiments/hidden_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/experiments/hidden_strength.hpp"
#include "bench/problems/random_muscles.hpp"
#include "bench/problems/truth.hpp"
#include "forward/anatomy/refine.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/half_model.hpp"
#include "forward/statics/equilibrium.hpp"
#include "inverse/prior/base/unknowns.hpp"

namespace genio::bench {
namespace {

namespace fs = std::filesystem;

constexpr double fibre_turn = 5;    // [degrees]
constexpr double largest = 0.15;    // of a muscle's maximum
constexpr int most_tries = 5;       // places of an effect, among the same postures
constexpr unsigned most_draws = 4;  // of postures, where a strength is out of reach

std::vector<Forces_N> postures(const std::vector<Unknown>& muscles, int count,
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

/// Shapes of the fine tongue, each from the one before whose coarse shape is nearest: a coarse
/// shape itself has wrong volumes between the nodes of the fine mesh. Fewer than forces where one
/// has none, then `failure` says why.
std::vector<Positions> fine_shapes(const Model& fine, const Model& coarse,
                                   const std::vector<Forces_N>& all, bool half,
                                   std::string& failure) {
  Workspace ws_coarse(coarse), ws(fine);
  SolveOptions options;
  options.tolerance = 1e-7;
  std::vector<Positions> from{coarse.rest}, shapes{fine.rest};
  for (const Forces_N& forces : all) {
    const Equilibrium rough =
        solve_equilibrium(coarse, commanded(coarse, forces, half), coarse.rest, ws_coarse, options);
    const auto distance = [&](const Positions& x) { return (x - rough.x).cwiseAbs().maxCoeff(); };
    const auto nearest =
        std::min_element(from.begin(), from.end(),
                         [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    const Equilibrium e =
        rough ? solve_equilibrium(fine, commanded(fine, forces, half),
                                  shapes[size_t(nearest - from.begin())], ws, options)
              : rough;
    if (!e) {
      failure = e.message;
      break;
    }
    from.push_back(rough.x), shapes.push_back(e.x);
  }
  shapes.erase(shapes.begin());
  return shapes;
}

void write_target(const std::string& path, const std::vector<Measured>& points) {
  std::ofstream out(path);
  out << "frame,point,x_mm,y_mm,z_mm,kind,slice\n";
  int k = 0;
  for (const auto& p : points)
    out << fmt::format("1,{},{:.4f},{:.4f},{:.4f},{},{}\n", ++k, 1e3 * p.position[0],
                       1e3 * p.position[1], 1e3 * p.position[2], p.kind, p.slice);
}

/// What a data set is made of.
struct Hidden {
  unsigned seed;
  std::vector<Forces_N> all;  ///< of the postures, those to fit first
  Changes changes;
};

/// None where the strength asked for is out of reach; `why` says of which effect.
std::optional<Hidden> hide(const ModelDescription& tongue, const HiddenCase& what, unsigned seed,
                           std::string& why) {
  std::mt19937 random(seed);
  Hidden h{seed,
           postures(muscle_unknowns(build_model(tongue, tongue.name), true),
                    what.fitted + what.heldout, random),
           {}};
  const std::vector<Forces_N> fitted(h.all.begin(), h.all.begin() + what.fitted);
  for (const std::string& name : what.effects) {
    HiddenChange c;
    double s = 0;
    bool found = false;
    for (int tries = 0; tries < most_tries && !found; ++tries) {  // at one place or another
      if (tries > 0 && !c.drawn) break;
      c = hidden_change(name, {tongue, most_used(fitted, tongue), what.forces_known, random});
      found = find_amplitude(tongue, c, fitted, what, what.strength, s);
    }
    if (!found) {
      why = fmt::format("{}: strength {} is out of reach", name, what.strength);
      return std::nullopt;
    }
    h.changes.all.push_back(c), h.changes.s.push_back(s);
  }
  return h;
}

}  // namespace

Json make_hidden_data(const ModelDescription& tongue, const HiddenCase& what,
                      const std::string& folder, const std::string& answer, KnownShapes& known) {
  const auto failed = [&](const std::string& why) {
    const Json j = {{"case", what.name}, {"failed", why}};
    std::ofstream(answer) << j.dump(1) << "\n";
    return j;
  };
  std::string why;
  std::optional<Hidden> hidden;
  for (unsigned draw = 0; draw < most_draws && !hidden; ++draw)
    hidden = hide(tongue, what, what.seed + 1000000 * draw, why);
  if (!hidden) return failed(why);
  const auto& [seed, all, changes] = *hidden;
  ModelDescription coarse = changes.truth(turned(tongue, seed));
  const bool half = changes.symmetric();
  if (half) coarse = half_of(coarse, "truth");
  const Model rough = changes.by_hand(build_model(coarse, "truth"));
  const Model fine = changes.by_hand(build_model(refined(coarse), "fine truth"));
  fs::create_directories(folder);
  std::mt19937 noise(what.noise_seed * 7919 + seed);
  std::normal_distribution<double> normal;
  std::string toml = fmt::format("noise_mm = {}\nnoise_correlation_mm = {}\n", 1e3 * what.noise,
                                 1e3 * what.correlation);
  if (what.forces_known) toml += fmt::format("force_sd_percent = {}\n", 100 * force_error);
  std::vector<Positions> shapes;
  if (what.effects.empty()) shapes = known[what.seed];
  if (shapes.empty()) {
    std::string failure;
    shapes = fine_shapes(fine, rough, all, half, failure);
    if (shapes.size() < all.size()) return failed("truth: " + failure);
  }
  if (what.effects.empty()) known[what.seed] = shapes;
  for (size_t k = 0; k < all.size(); ++k) {
    auto points = seen(fine, shapes[k], what, changes, noise);
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
  Json told = Json::array();
  for (size_t i = 0; i < changes.all.size(); ++i)
    told.push_back({{"effect", changes.all[i].effect},
                    {"where", changes.all[i].where},
                    {"in_library", changes.all[i].in_library},
                    {"amplitude", changes.s[i]},
                    {"parameters", changes.all[i].parameters(changes.s[i])}});
  const Json j = {{"case", what.name},
                  {"hidden", told},
                  {"seed", seed},
                  {"strength", what.strength},
                  {"forces_known", what.forces_known},
                  {"surface", what.surface}};
  std::ofstream(answer) << j.dump(1) << "\n";
  return j;
}

}  // namespace genio::bench
