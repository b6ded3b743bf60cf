#include "inverse/search/atlas.hpp"

#include <algorithm>

#include "forward/statics/sensitivity.hpp"
#include "inverse/shape/curvature.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr double levels[] = {0.06, 0.15, 0.3};
constexpr size_t most_atlases = 3;  // some 10 to 40 MB each

bool is_for(const Atlas& atlas, const std::vector<Unknown>& unknowns, const PriorTerms& terms) {
  return atlas.names.size() == unknowns.size() &&
         std::equal(unknowns.begin(), unknowns.end(), atlas.names.begin(),
                    [](const Unknown& c, const auto& name) { return c.name == name; }) &&
         atlas.lower == terms.lower && atlas.upper == terms.upper;
}

}  // namespace

Atlas make_atlas(const Model& model, const Prior& prior, bool bilateral, Workspace& ws,
                 const StopAtlas& stop) {
  const auto unknowns = unknowns_of(model, prior, bilateral);
  const PriorTerms terms = prior_terms(prior, unknowns);
  const Parameters base = default_parameters(model);
  const auto n = Eigen::Index(unknowns.size());
  const Vector rest = Vector::Zero(n).cwiseMax(terms.lower).cwiseMin(terms.upper);
  Atlas atlas;
  for (const Unknown& c : unknowns) atlas.names.push_back(c.name);
  atlas.lower = terms.lower, atlas.upper = terms.upper;
  const auto add = [&](const Vector& z, const Positions& start) {
    SolveOptions options;
    options.max_load_steps = 4;
    const auto e = solve_equilibrium(model, apply_unknowns(unknowns, z, base), start, ws, options);
    if (!e) return false;
    Matrix by_unknown =
        sensitivity_to_forces(model, e, force_by_unknown(model, unknowns, e.x, e.parameters), ws);
    if (by_unknown.size() == 0) return false;
    atlas.entries.push_back({z, e.x, std::move(by_unknown)});
    return true;
  };
  if (!add(rest, model.rest)) return atlas;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (unknowns[size_t(i)].kind != Unknown::Kind::muscle || terms.fixed(i)) continue;
    Positions from = atlas.entries.front().shape;
    for (const double level : levels) {
      if (stop && stop()) return atlas;
      Vector z = rest;
      z[i] = level;
      if (!add(z, from)) break;
      from = atlas.entries.back().shape;
    }
  }
  return atlas;
}

const Atlas& AtlasCache::get(const Model& model, const Prior& prior, bool bilateral, Workspace& ws,
                             const StopAtlas& stop) {
  const auto unknowns = unknowns_of(model, prior, bilateral);
  const PriorTerms terms = prior_terms(prior, unknowns);
  const auto known = std::find_if(atlases_.begin(), atlases_.end(),
                                  [&](const Atlas& a) { return is_for(a, unknowns, terms); });
  if (known != atlases_.end()) {
    atlases_.splice(atlases_.begin(), atlases_, known);
    return atlases_.front();
  }
  Atlas made = make_atlas(model, prior, bilateral, ws, stop);
  if (stop && stop()) return unfinished_ = std::move(made);
  atlases_.push_front(std::move(made));
  if (atlases_.size() > most_atlases) atlases_.pop_back();
  return atlases_.front();
}

std::vector<const Atlas::Entry*> nearest(const Atlas& atlas, const Comparison& comparison,
                                         const std::vector<Unknown>& unknowns,
                                         const PriorTerms& prior) {
  std::vector<std::pair<double, const Atlas::Entry*>> rated;
  for (const auto& e : atlas.entries)
    rated.emplace_back(
        0.5 * comparison(e.shape, head_pose(unknowns, e.unknowns)).values.squaredNorm() +
            prior.value(e.unknowns),
        &e);
  std::stable_sort(rated.begin(), rated.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const Atlas::Entry*> result;
  for (const auto& [value, entry] : rated) result.push_back(entry);
  return result;
}

}  // namespace genio
