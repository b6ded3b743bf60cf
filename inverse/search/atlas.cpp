#include "inverse/search/atlas.hpp"

#include <algorithm>

#include "forward/statics/sensitivity.hpp"
#include "inverse/shape/curvature.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr double levels[] = {0.06, 0.15, 0.3};

/// The atlas of all these unknowns, of which those that it does not have change no shape.
Atlas extended(Atlas atlas, const std::vector<Unknown>& unknowns) {
  const auto count = Eigen::Index(unknowns.size());
  atlas.lower.conservativeResize(count), atlas.upper.conservativeResize(count);
  for (size_t i = atlas.names.size(); i < unknowns.size(); ++i) {
    atlas.names.push_back(unknowns[i].name);
    atlas.lower[Eigen::Index(i)] = unknowns[i].lower;
    atlas.upper[Eigen::Index(i)] = unknowns[i].upper;
  }
  for (Atlas::Entry& entry : atlas.entries) {
    const Eigen::Index known = entry.unknowns.size();
    entry.unknowns.conservativeResizeLike(Vector::Zero(count));
    const Matrix by_known = std::move(entry.by_unknown);
    entry.by_unknown = Matrix::Zero(by_known.rows(), count);
    entry.by_unknown.leftCols(known) = by_known;
  }
  return atlas;
}

}  // namespace

Atlas make_atlas(const Model& model, const Prior& prior, bool bilateral, Workspace& ws) {
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
      Vector z = rest;
      z[i] = level;
      if (!add(z, from)) break;
      from = atlas.entries.back().shape;
    }
  }
  return atlas;
}

const Atlas& AtlasCache::get(const Model& model, const Prior& prior, bool bilateral,
                             Workspace& ws) {
  Prior still = prior;
  still.head_pose.reset(), still.before.reset();  // neither counts for what shapes there are
  const auto unknowns = unknowns_of(model, still, bilateral);
  const PriorTerms terms = prior_terms(still, unknowns);
  const bool same = atlas_ && atlas_->names.size() == unknowns.size() &&
                    std::equal(unknowns.begin(), unknowns.end(), atlas_->names.begin(),
                               [](const Unknown& c, const auto& name) { return c.name == name; }) &&
                    atlas_->lower == terms.lower && atlas_->upper == terms.upper;
  if (!same) atlas_ = make_atlas(model, still, bilateral, ws), posed_.reset();
  if (!prior.head_pose) return *atlas_;
  if (!posed_)  // the pose is the last of the unknowns
    posed_ = extended(*atlas_, unknowns_of(model, prior, bilateral));
  return *posed_;
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
