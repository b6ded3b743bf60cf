#include "inverse/posterior/acting.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <unordered_map>

#include "inverse/posterior/box_integral.hpp"

namespace genio {
namespace {

using Acts = std::vector<bool>;

constexpr size_t few = 8;            // unknowns, all choices of which are weighed
constexpr int sweeps = 60;           // of the Markov chain
constexpr double least_log = -11;    // of a state that counts, below the likeliest
constexpr size_t most_states = 400;  // all of which are sampled
constexpr size_t most_others = 100;  // drawn of the rest
constexpr int least_samples = 16;    // of a state
constexpr int left_out = 12;         // samples left out of each

/// log of the half-normal's integral over [0, length].
double log_half_normal(double sd, double length) {
  return std::log(sd * std::sqrt(std::numbers::pi / 2) *
                  std::erf(length / (sd * std::numbers::sqrt2)));
}

/// The states of one problem and their logarithmic weights, each integrated once.
class Weights {
 public:
  Weights(const QuadraticDensity& density, const RestBelief& belief)
      : density_(density), belief_(belief), count_(belief.slab.size()) {
    for (Eigen::Index i = 0; i < count_; ++i)
      if (rests(i)) resting_.push_back(i);
    for (Eigen::Index i : resting_) groups_ += belief.partner[size_t(i)] < i;
  }

  bool rests(Eigen::Index i) const { return belief_.slab[i] > 0; }
  /// What may rest.
  const std::vector<Eigen::Index>& resting() const { return resting_; }
  size_t widths() const { return belief_.widths.size(); }
  /// A state's key: what acts, then its width.
  Acts key(const Acts& acts, size_t width) const {
    Acts all = acts;
    for (size_t k = 0; k < widths(); ++k) all.push_back(k == width);
    return all;
  }
  double operator()(const Acts& key) {
    const auto known = logs_.find(key);
    if (known != logs_.end()) return known->second;
    double log = 0;
    const BoxGaussian g = gaussian(key, log);
    if (g.mode.size() > 0 && std::isfinite(log)) log += log_integral(g);
    return logs_[key] = std::isnan(log) ? -std::numeric_limits<double>::infinity() : log;
  }
  /// The Gaussian of what acts, and the logarithm of its value at the mode with the prior's weight.
  BoxGaussian gaussian(const Acts& key, double& log) const {
    const auto which = acting(key);
    const double width = belief_.widths[width_of(key)];
    Matrix h = density_.hessian(which, which);
    log = log_prior(key);
    for (size_t k = 0; k < which.size(); ++k) {
      const Eigen::Index i = which[k], other = belief_.partner[size_t(i)];
      if (!rests(i)) continue;
      const double sd = width * belief_.slab[i];
      log -= log_half_normal(sd, density_.upper[i]);
      const double rho = other >= 0 && key[size_t(other)] ? belief_.alike : 0;
      h(Eigen::Index(k), Eigen::Index(k)) += 1 / (sd * sd * (1 - rho * rho));
      if (rho == 0 || other > i) continue;
      // The normal of two alike sides, over its quarter of the plane.
      const auto at = std::find(which.begin(), which.end(), other) - which.begin();
      const double across = -rho / (sd * width * belief_.slab[other] * (1 - rho * rho));
      h(Eigen::Index(k), at) += across, h(at, Eigen::Index(k)) += across;
      log -= 0.5 * std::log(1 - rho * rho) + std::log1p(2 / std::numbers::pi * std::asin(rho));
    }
    const Vector pull = density_.pull(which);
    const Eigen::LLT<Matrix> factor(h);
    if (!which.empty() && factor.info() != Eigen::Success)
      log = -std::numeric_limits<double>::infinity();
    const Vector centre = which.empty() ? Vector() : Vector(factor.solve(pull));
    BoxGaussian g = about(centre, h, density_.lower(which), density_.upper(which));
    if (!which.empty()) log += pull.dot(g.mode) - 0.5 * g.mode.dot(h * g.mode);
    return g;
  }
  std::vector<Eigen::Index> acting(const Acts& key) const {
    std::vector<Eigen::Index> which;
    for (Eigen::Index i = 0; i < count_; ++i)
      if (key[size_t(i)]) which.push_back(i);
    return which;
  }
  /// Those that were asked for, likeliest first.
  std::vector<ActingState> likeliest() const {
    double top = -std::numeric_limits<double>::infinity(), sum = 0;
    for (const auto& [key, log] : logs_) top = std::max(top, log);
    std::vector<ActingState> states;
    for (const auto& [key, log] : logs_)
      if (log > top + least_log)
        states.push_back(
            {Acts(key.begin(), key.begin() + count_), width_of(key), std::exp(log - top)});
    // The order of a hash table is no order.
    std::sort(states.begin(), states.end(), [](const ActingState& a, const ActingState& b) {
      return std::tie(b.weight, b.width, b.acts) < std::tie(a.weight, a.width, a.acts);
    });
    for (const ActingState& s : states) sum += s.weight;
    for (ActingState& s : states) s.weight /= sum;
    return states;
  }

 private:
  size_t width_of(const Acts& key) const {
    return size_t(std::find(key.begin() + count_, key.end(), true) - key.begin() - count_);
  }
  /// Every number of acting groups is equally likely, and every choice of so many.
  double log_prior(const Acts& key) const {
    int acting = 0;
    double log = 0;
    for (Eigen::Index i : resting_) {
      const Eigen::Index other = belief_.partner[size_t(i)];
      if (other > i) continue;  // counted with it
      const bool here = key[size_t(i)], there = other >= 0 && key[size_t(other)];
      acting += here || there;
      if (other >= 0 && (here || there))
        log += std::log(here && there ? belief_.both : 0.5 * (1 - belief_.both));
    }
    return log + std::lgamma(acting + 1) + std::lgamma(groups_ - acting + 1) -
           std::lgamma(groups_ + 2);
  }

  const QuadraticDensity& density_;
  const RestBelief& belief_;
  Eigen::Index count_;
  std::vector<Eigen::Index> resting_;
  int groups_ = 0;
  std::unordered_map<Acts, double> logs_;
};

void weigh_all(Weights& weights, const Acts& all) {
  const auto& resting = weights.resting();
  for (size_t bits = 0; bits < size_t(1) << resting.size(); ++bits) {
    Acts acts = all;
    for (size_t k = 0; k < resting.size(); ++k) acts[size_t(resting[k])] = bits >> k & 1;
    for (size_t w = 0; w < weights.widths(); ++w) weights(weights.key(acts, w));
  }
}

/// The changes of one step that the search tries: one unknown, both sides of a muscle, or the
/// width.
std::vector<std::vector<size_t>> steps(const Weights& weights, const RestBelief& belief,
                                       size_t count) {
  std::vector<std::vector<size_t>> all;
  for (Eigen::Index i : weights.resting()) {
    all.push_back({size_t(i)});
    if (const auto other = belief.partner[size_t(i)]; other > i)
      all.push_back({size_t(i), size_t(other)});
  }
  for (size_t a = 0; a < weights.widths(); ++a)
    for (size_t b = 0; b < a; ++b) all.push_back({count + a, count + b});
  return all;
}

Acts flipped(Acts key, const std::vector<size_t>& step) {
  for (size_t i : step) key[i] = !key[i];
  return key;
}

/// A step between two widths is one only from either of them.
bool possible(const Acts& key, const std::vector<size_t>& step, size_t count) {
  return step.size() < 2 || step[0] < count || key[step[0]] != key[step[1]];
}

/// Downhill from all that act, then a Gibbs sampler with exchanges of one unknown for another.
void visit(Weights& weights, const RestBelief& belief, const Acts& all) {
  const size_t count = all.size();
  const auto every = steps(weights, belief, count);
  Acts here = weights.key(all, weights.widths() / 2);
  for (bool better = true; better;) {
    better = false;
    Acts best = here;
    for (const auto& step : every)
      if (possible(here, step, count))
        if (const Acts there = flipped(here, step); weights(there) > weights(best))
          best = there, better = true;
    here = best;
  }
  std::mt19937_64 random(20260101);
  std::uniform_real_distribution<double> uniform;
  const auto& resting = weights.resting();
  const auto any = [&] {
    return size_t(resting[size_t(uniform(random) * double(resting.size()))]);
  };
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (const auto& step : every) {
      if (!possible(here, step, count)) continue;
      const Acts there = flipped(here, step);
      if (uniform(random) < 1 / (1 + std::exp(weights(here) - weights(there)))) here = there;
    }
    for (size_t k = 0; k < resting.size() / 2; ++k) {
      const size_t i = any(), j = any();
      if (here[i] == here[j]) continue;
      const Acts there = flipped(here, {i, j});
      if (uniform(random) < std::exp(weights(there) - weights(here))) here = there;
    }
  }
}

}  // namespace

std::vector<ActingState> acting_states(const QuadraticDensity& density, const RestBelief& belief) {
  Weights weights(density, belief);
  const Acts all(size_t(belief.slab.size()), true);
  if (weights.resting().size() <= few) weigh_all(weights, all);
  else visit(weights, belief, all);
  auto states = weights.likeliest();
  if (states.empty())
    throw std::runtime_error(
        "no posterior can be computed: the standard deviations of the prior are too small or too "
        "large beside those of the data");
  return states;
}

double prior_sd(const RestBelief& belief, Eigen::Index i) {
  double mean = 0, square = 0;  // it acts with probability 1/2
  for (double width : belief.widths) {
    const double sd = width * belief.slab[i];
    mean += 0.5 * sd * std::sqrt(2 / std::numbers::pi) / double(belief.widths.size());
    square += 0.5 * sd * sd / double(belief.widths.size());
  }
  return std::sqrt(square - mean * mean);
}

namespace {

/// The likeliest states, and of the others some by their weights, each for its share of them all.
std::vector<ActingState> sampled_states(const std::vector<ActingState>& states) {
  if (states.size() <= most_states + most_others) return states;
  std::vector<ActingState> result(states.begin(), states.begin() + most_states);
  double rest = 0, passed = 0;
  for (size_t k = most_states; k < states.size(); ++k) rest += states[k].weight;
  const double share = rest / double(most_others);
  size_t drawn = 0;
  for (size_t k = most_states; k < states.size(); ++k) {
    passed += states[k].weight;
    for (; drawn < most_others && (double(drawn) + 0.5) * share < passed; ++drawn)
      result.push_back({states[k].acts, states[k].width, share});
  }
  return result;
}

}  // namespace

WeightedSamples sample(const QuadraticDensity& density, const RestBelief& belief,
                       const std::vector<ActingState>& all_states, int count) {
  const std::vector<ActingState> states = sampled_states(all_states);
  const Weights weights(density, belief);
  std::vector<Eigen::Index> numbers;
  Eigen::Index total = 0;
  for (const ActingState& s : states) {
    numbers.push_back(Eigen::Index(std::ceil(count * s.weight)) + least_samples);
    total += numbers.back();
  }
  WeightedSamples all{Matrix::Zero(density.pull.size(), total), Vector(total)};
  Eigen::Index at = 0;
  for (size_t k = 0; k < states.size(); ++k) {
    double log = 0;
    const Acts key = weights.key(states[k].acts, states[k].width);
    const BoxGaussian g = weights.gaussian(key, log);
    const auto columns = Eigen::seqN(at, numbers[k]);
    if (g.mode.size() > 0)
      all.values(weights.acting(key), columns) =
          sample(at_mode(g), int(numbers[k]), left_out, unsigned(k + 1));
    all.weights(columns).setConstant(states[k].weight / double(numbers[k]));
    at += numbers[k];
  }
  return all;
}

}  // namespace genio
