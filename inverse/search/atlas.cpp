#include "inverse/search/atlas.hpp"

#include <algorithm>

#include "forward/statics/sensitivity.hpp"
#include "inverse/shape/curvature.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr double levels[] = {0.06, 0.15, 0.3};
constexpr size_t most_atlases = 3;  // some 10 to 40 MB each

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

AtlasMaker::AtlasMaker(const Model& model, const Prior& prior, bool bilateral)
    : unknowns_(unknowns_of(model, prior, bilateral)) {
  const PriorTerms terms = prior_terms(prior, unknowns_);
  const auto n = Eigen::Index(unknowns_.size());
  rest_ = Vector::Zero(n).cwiseMax(terms.lower).cwiseMin(terms.upper);
  for (const Unknown& c : unknowns_) atlas_.names.push_back(c.name);
  atlas_.lower = terms.lower, atlas_.upper = terms.upper;
  for (Eigen::Index i = n; i-- > 0;)
    if (unknowns_[size_t(i)].kind == Unknown::Kind::muscle && !terms.fixed(i))
      for (size_t level = std::size(levels); level-- > 0;) left_.push_back({i, level});
}

bool AtlasMaker::is_for(const std::vector<Unknown>& unknowns, const PriorTerms& terms) const {
  return atlas_.names.size() == unknowns.size() &&
         std::equal(unknowns.begin(), unknowns.end(), atlas_.names.begin(),
                    [](const Unknown& c, const auto& name) { return c.name == name; }) &&
         atlas_.lower == terms.lower && atlas_.upper == terms.upper;
}

bool AtlasMaker::add(const Model& model, const Vector& z, const Positions& start, Workspace& ws) {
  SolveOptions options;
  options.max_load_steps = 4;
  const auto e = solve_equilibrium(model, apply_unknowns(unknowns_, z, default_parameters(model)),
                                   start, ws, options);
  if (!e) return false;
  Matrix by_unknown =
      sensitivity_to_forces(model, e, force_by_unknown(model, unknowns_, e.x, e.parameters), ws);
  if (by_unknown.size() == 0) return false;
  by_unknown += held_by_unknown(model, unknowns_, e.parameters);
  atlas_.entries.push_back({z, e.x, std::move(by_unknown)});
  return true;
}

bool AtlasMaker::go_on(const Model& model, Workspace& ws, const StopAtlas& stop) {
  if (atlas_.entries.empty() && !add(model, rest_, model.rest, ws)) left_.clear();
  while (!left_.empty() && !(stop && stop())) {
    const Single next = left_.back();
    left_.pop_back();
    Vector z = rest_;
    z[next.muscle] = levels[next.level];
    const Atlas::Entry& from = next.level == 0 ? atlas_.entries.front() : atlas_.entries.back();
    if (!add(model, z, Positions(from.shape), ws))
      std::erase_if(left_, [&](const Single& s) { return s.muscle == next.muscle; });
  }
  return left_.empty();
}

Atlas make_atlas(const Model& model, const Prior& prior, bool bilateral, Workspace& ws) {
  AtlasMaker maker(model, prior, bilateral);
  maker.go_on(model, ws);
  return maker.atlas();
}

const Atlas& AtlasCache::get(const Model& model, const Prior& prior, bool bilateral, Workspace& ws,
                             const StopAtlas& stop) {
  Prior still = prior;
  still.head_pose.reset(), still.before.reset();  // neither counts for what shapes there are
  const auto unknowns = unknowns_of(model, still, bilateral);
  const PriorTerms terms = prior_terms(still, unknowns);
  const auto known = std::find_if(makers_.begin(), makers_.end(),
                                  [&](const AtlasMaker& m) { return m.is_for(unknowns, terms); });
  if (known != makers_.end()) makers_.splice(makers_.begin(), makers_, known);
  else makers_.emplace_front(model, still, bilateral);
  if (makers_.size() > most_atlases) {
    if (posed_of_ == &makers_.back()) posed_of_ = nullptr;  // another may come to lie there
    makers_.pop_back();
  }
  AtlasMaker& maker = makers_.front();
  maker.go_on(model, ws, stop);
  if (!prior.head_pose) return maker.atlas();
  // The pose is the last of the unknowns.
  const bool fresh =
      posed_ && posed_of_ == &maker && posed_->entries.size() == maker.atlas().entries.size();
  if (!fresh) posed_ = extended(maker.atlas(), unknowns_of(model, prior, bilateral));
  posed_of_ = &maker;
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
