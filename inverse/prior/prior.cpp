#include "inverse/prior/prior.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "forward/base/nearest_name.hpp"

namespace genio {
namespace {

constexpr double pose_range = 4;        // standard deviations that a head pose may reach
constexpr double parameter_range = 20;  // and a parameter of an effect

std::vector<std::string> names(const std::vector<Unknown>& unknowns) {
  std::vector<std::string> result;
  for (const Unknown& c : unknowns) {
    result.push_back(c.name);
    if (const auto both = bilateral_name(c.name); both != c.name) result.push_back(both);
  }
  return result;
}

/// Unknown muscles that a name speaks of: itself or its two sides.
std::vector<Eigen::Index> muscles_named(const std::vector<Unknown>& unknowns,
                                        const std::string& name, const char* who) {
  std::vector<Eigen::Index> result;
  for (size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].kind == Unknown::Kind::muscle &&
        (unknowns[i].name == name || bilateral_name(unknowns[i].name) == name))
      result.push_back(Eigen::Index(i));
  if (result.empty())
    throw InputError(fmt::format("{} {}: no such muscle among the unknowns; did you mean {}?", who,
                                 name, nearest_name(name, names(unknowns))));
  return result;
}

/// Collects rows w.z = v with a standard deviation.
class Rows {
 public:
  explicit Rows(Eigen::Index unknowns) : size_(unknowns) {}
  void add(const Vector& weights, double value, double sd) {
    rows_.push_back(weights / sd), values_.push_back(value / sd);
  }
  void add(Eigen::Index i, double value, double sd) { add(Vector::Unit(size_, i), value, sd); }
  void into(PriorTerms& terms) const {
    terms.rows.resize(Eigen::Index(rows_.size()), size_);
    for (size_t k = 0; k < rows_.size(); ++k)
      terms.rows.row(Eigen::Index(k)) = rows_[k].transpose();
    terms.values = Eigen::Map<const Vector>(values_.data(), Eigen::Index(values_.size()));
  }

 private:
  Eigen::Index size_;
  std::vector<Vector> rows_;
  std::vector<double> values_;
};

void need_positive(double sd, const char* what) {
  if (!(sd > 0) || !std::isfinite(sd))
    throw InputError(fmt::format("{}: standard deviation {}; expected a number above 0", what, sd));
}

void hold_fixed(const Prior& prior, const std::vector<Unknown>& unknowns, PriorTerms& terms) {
  for (const auto& [name, force] : prior.fixed) {
    const auto which = muscles_named(unknowns, name, "fixed");
    double maximum = 0;
    for (auto i : which) maximum += unknowns[size_t(i)].scale;
    if (!(force >= 0 && force <= maximum * (1 + 1e-12)))
      throw InputError(
          fmt::format("fixed {}: force {} N; expected 0 to {} N", name, force, maximum));
    for (auto i : which) terms.lower[i] = terms.upper[i] = std::min(1.0, force / maximum);
  }
}

}  // namespace

std::vector<Unknown> unknowns_of(const Model& model, const Prior& prior, bool bilateral) {
  std::vector<Unknown> result = muscle_unknowns(model, bilateral);
  for (const auto& [name, belief] : prior.parameters) {
    need_positive(belief.sd, name.c_str());
    const std::vector<int> which = parameters_named(model, name);
    const auto& info = model.parameters[size_t(which.front())].info;
    const double lower = std::max(info.lower, belief.lower);
    const double upper = std::min(info.upper, belief.upper);
    if (!(belief.mean >= lower && belief.mean <= upper))
      throw InputError(fmt::format("parameter {}: mean {} {}; expected {} to {}", name, belief.mean,
                                   info.unit, lower, upper));
    if (belief.ratio && !(lower > 0)) throw std::invalid_argument(name + " has no logarithm");
    Unknown c{name,     1, which, std::vector<double>(which.size(), 1.0), Unknown::Kind::parameter,
              info.unit};
    c.ratio = belief.ratio;
    const double least = c.z_of(lower), most = c.z_of(upper), mean = c.z_of(belief.mean);
    // Bounds may be far beyond what is believed; the unit is what may be reached.
    c.scale = std::min(std::max(std::abs(least), std::abs(most)),
                       std::abs(mean) + parameter_range * belief.sd);
    c.lower = std::max(-1.0, least / c.scale), c.upper = std::min(1.0, most / c.scale);
    result.push_back(std::move(c));
  }
  if (prior.head_pose) {
    const auto& pose = *prior.head_pose;
    need_positive(pose.shift_sd, "head_pose shift");
    need_positive(pose.turn_sd, "head_pose turn");
    for (const char* name : {"head_pose.x", "head_pose.z"})
      result.push_back({name, pose_range * pose.shift_sd, {}, {}, Unknown::Kind::pose, "m", -1, 1});
    result.push_back(
        {"head_pose.turn", pose_range * pose.turn_sd, {}, {}, Unknown::Kind::pose, "rad", -1, 1});
  }
  return result;
}

PriorTerms prior_terms(const Prior& prior, const std::vector<Unknown>& unknowns) {
  const Eigen::Index n = Eigen::Index(unknowns.size());
  need_positive(prior.effort_sd, "effort");
  PriorTerms terms{{}, {}, Vector(n), Vector(n)};
  Rows rows(n);
  std::vector<bool> measured(unknowns.size(), false);
  for (const auto& [name, belief] : prior.emg) {
    need_positive(belief.sd, name.c_str());
    for (auto i : muscles_named(unknowns, name, "EMG of")) {
      rows.add(i, belief.mean, belief.sd);
      measured[size_t(i)] = true;
    }
  }
  Vector share = Vector::Zero(n);
  Eigen::Index muscles = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Unknown& c = unknowns[size_t(i)];
    terms.lower[i] = c.lower, terms.upper[i] = c.upper;
    if (c.kind == Unknown::Kind::muscle) {
      if (!measured[size_t(i)]) rows.add(i, 0, prior.effort_sd);
      share[i] = 1, ++muscles;
      for (Eigen::Index j = 0; j < i; ++j)
        if (prior.symmetry_sd && unknowns[size_t(j)].kind == Unknown::Kind::muscle &&
            bilateral_name(unknowns[size_t(j)].name) == bilateral_name(c.name)) {
          need_positive(*prior.symmetry_sd, "symmetry");
          rows.add(Vector::Unit(n, i) - Vector::Unit(n, j), 0, *prior.symmetry_sd);
        }
    } else if (c.kind == Unknown::Kind::parameter) {
      const ParameterPrior& belief = prior.parameters.at(c.name);
      rows.add(i, c.z_of(belief.mean), belief.sd / c.scale);
    } else {
      rows.add(i, 0, 1 / pose_range);
    }
  }
  if (prior.cocontraction) {
    need_positive(prior.cocontraction->sd, "cocontraction");
    rows.add(share / double(muscles), prior.cocontraction->mean, prior.cocontraction->sd);
  }
  if (prior.before) {
    need_positive(prior.before->sd, "smoothness");
    if (prior.before->activations.size() != n)
      throw std::invalid_argument("the frame before has other unknowns");
    for (Eigen::Index i = 0; i < n; ++i)
      if (unknowns[size_t(i)].kind != Unknown::Kind::pose)
        rows.add(i, prior.before->activations[i], prior.before->sd);
  }
  rows.into(terms);
  hold_fixed(prior, unknowns, terms);
  return terms;
}

std::vector<Eigen::Index> PriorTerms::open() const {
  std::vector<Eigen::Index> result;
  for (Eigen::Index i = 0; i < lower.size(); ++i)
    if (!fixed(i)) result.push_back(i);
  return result;
}

Prior with_effort(Prior prior, double times) {
  prior.effort_sd *= times;
  return prior;
}

}  // namespace genio
