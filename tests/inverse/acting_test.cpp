#include "inverse/posterior/acting.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "inverse/posterior/box_integral.hpp"
#include "inverse/posterior/distributions.hpp"

namespace genio {
namespace {

RestBelief belief(Eigen::Index count, double slab) {
  RestBelief b;
  b.slab = Vector::Constant(count, slab);
  b.partner.assign(size_t(count), -1);
  return b;
}

/// What `rows` z + noise of 1 = `seen` says.
QuadraticDensity density(const Matrix& rows, const Vector& seen) {
  return {rows.transpose() * rows, rows.transpose() * seen, Vector::Zero(rows.cols()),
          Vector::Ones(rows.cols())};
}

double acts(const std::vector<ActingState>& states, size_t i) {
  double sum = 0;
  for (const ActingState& s : states) sum += s.acts[i] ? s.weight : 0;
  return sum;
}

double half_normal(double z, double sd) {
  const double mass = std::erf(1 / (sd * std::sqrt(2)));
  return std::sqrt(2 / M_PI) / sd * std::exp(-0.5 * z * z / (sd * sd)) / mass;
}

Matrix random_matrix(Eigen::Index rows, Eigen::Index columns, double size, std::mt19937& random) {
  std::normal_distribution<double> normal(0, size);
  Matrix m(rows, columns);
  for (double& e : m.reshaped()) e = normal(random);
  return m;
}

TEST(ActingStates, AreAsLikelyAsSumsOverAGridSay) {
  const Matrix rows{{12, 9}, {3, -5}};
  const Vector seen{{2.2, 0.3}};
  const QuadraticDensity d = density(rows, seen);
  const RestBelief b = belief(2, 0.1);
  // By hand: both rest, either, both; the number of acting ones is 0, 1, 2 with 1/3 each.
  constexpr int cells = 2000;
  double weight[4] = {0, 0, 0, 0};
  const auto likelihood = [&](double x, double y) {
    return std::exp(-0.5 * (rows * Vector{{x, y}} - seen).squaredNorm());
  };
  weight[0] = likelihood(0, 0) / 3;
  for (double width : b.widths) {
    const double sd = 0.1 * width, part = 1 / double(b.widths.size());
    for (int i = 0; i < cells; ++i) {
      const double x = (i + 0.5) / cells, h = half_normal(x, sd) / cells;
      weight[1] += part / 6 * h * likelihood(x, 0), weight[2] += part / 6 * h * likelihood(0, x);
      for (int j = 0; j < 400; ++j) {
        const double y = (j + 0.5) / 400;
        weight[3] += part / 3 * h * half_normal(y, sd) / 400 * likelihood(x, y);
      }
    }
  }
  const double sum = weight[0] + weight[1] + weight[2] + weight[3];
  const auto states = acting_states(d, b);
  EXPECT_NEAR(acts(states, 0), (weight[1] + weight[3]) / sum, 5e-3);
  EXPECT_NEAR(acts(states, 1), (weight[2] + weight[3]) / sum, 5e-3);
}

TEST(ActingStates, OfTwoSidesShareOneSlabThatIsANormalOfTheirQuarter) {
  const Matrix rows{{10, 0}, {0, 10}};
  const Vector seen{{1.0, 1.4}};
  RestBelief b = belief(2, 0.1);
  b.partner = {1, 0}, b.widths = {1};
  const double rho = b.alike, sd = 0.1;
  double mass = 0, both = 0, one[2] = {0, 0};
  constexpr int cells = 1200;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const double x = (i + 0.5) / cells, y = (j + 0.5) / cells;
      const double p =
          std::exp(-0.5 * (x * x - 2 * rho * x * y + y * y) / (sd * sd * (1 - rho * rho)));
      mass += p, both += p * std::exp(-0.5 * (rows * Vector{{x, y}} - seen).squaredNorm());
    }
  for (int i = 0; i < cells; ++i) {
    const double x = (i + 0.5) / cells, h = half_normal(x, sd) / cells;
    one[0] += h * std::exp(-0.5 * (rows * Vector{{x, 0}} - seen).squaredNorm());
    one[1] += h * std::exp(-0.5 * (rows * Vector{{0, x}} - seen).squaredNorm());
  }
  // One muscle: it rests or acts with 1/2 each.
  const double none = 0.5 * std::exp(-0.5 * seen.squaredNorm());
  const double alone = 0.5 * 0.5 * (1 - b.both);
  const double together = 0.5 * b.both * both / mass;
  const double sum = none + alone * (one[0] + one[1]) + together;
  const auto states = acting_states(density(rows, seen), b);
  EXPECT_NEAR(acts(states, 0), (together + alone * one[0]) / sum, 5e-3);
  EXPECT_NEAR(acts(states, 1), (together + alone * one[1]) / sum, 5e-3);
}

TEST(ActingStates, AChainFindsWhatWeighingAllDoes) {
  // Ten unknowns are too many to weigh all: 2^10 choices here by the same integrals.
  std::mt19937 random(3);
  constexpr Eigen::Index n = 10;
  const Matrix rows = random_matrix(14, n, 12, random);
  Vector truth = Vector::Zero(n);
  truth[1] = 0.15, truth[4] = 0.05, truth[7] = 0.2;
  const QuadraticDensity d = density(rows, rows * truth + random_matrix(14, 1, 1, random));
  RestBelief b = belief(n, 0.1);
  b.widths = {1};
  Vector by_all = Vector::Zero(n);
  double sum = 0;
  for (unsigned bits = 0; bits < 1u << n; ++bits) {
    std::vector<Eigen::Index> which;
    for (Eigen::Index i = 0; i < n; ++i)
      if (bits >> i & 1) which.push_back(i);
    const auto k = double(which.size());
    double log = std::lgamma(k + 1) + std::lgamma(n - k + 1) + k * std::log(half_normal(0, 0.1));
    if (!which.empty()) {
      Matrix h = d.hessian(which, which);
      h.diagonal().array() += 100;
      const Vector pull = d.pull(which);
      const BoxGaussian g = about(h.llt().solve(pull), h, d.lower(which), d.upper(which));
      log += pull.dot(g.mode) - 0.5 * g.mode.dot(h * g.mode) + log_integral(g);
    }
    const double weight = std::exp(log - 40);
    sum += weight;
    for (auto i : which) by_all[i] += weight;
  }
  const auto states = acting_states(d, b);
  for (Eigen::Index i = 0; i < n; ++i)
    EXPECT_NEAR(acts(states, size_t(i)), by_all[i] / sum, 0.01) << i;
}

TEST(ActingSamples, OfCorrelatedForcesAreThoseOfTheirDensity) {
  // The first force is pulled below its bound and the second one above it: with the bounds clipped
  // one by one the first would seem pressed far harder than it is.
  const Matrix hessian = 1e4 * Matrix{{1, 0.99}, {0.99, 1}};
  const Vector centre{{-0.35, 0.6}};
  QuadraticDensity d{hessian, hessian * centre, Vector::Zero(2), Vector::Ones(2)};
  RestBelief b = belief(2, 0.1);
  b.slab.setZero();
  double mass = 0, mean = 0, least = 1e9;
  for (const bool first : {true, false})
    for (int i = 0; i < 1000; ++i)
      for (int j = 0; j < 1000; ++j) {
        const double x = (i + 0.5) * 2e-4;
        const Vector off = Vector{{x, 0.15 + (j + 0.5) * 2e-4}} - centre;
        const double q = off.dot(hessian * off);
        if (first) least = std::min(least, q);
        else mass += std::exp(0.5 * (least - q)), mean += x * std::exp(0.5 * (least - q));
      }
  const WeightedSamples s = sample(d, b, acting_states(d, b), 4000);
  EXPECT_NEAR(s.values.row(0) * s.weights, mean / mass, 0.1 * mean / mass);
}

TEST(ActingSamples, OfManyStatesActAsOftenAsAllOfThemSay) {
  // Data that say nothing: every number of acting ones is as likely, and the likeliest four hundred
  // states are not a half of them.
  constexpr Eigen::Index n = 8;
  QuadraticDensity d{Matrix::Identity(n, n), Vector::Zero(n), Vector::Zero(n), Vector::Ones(n)};
  const RestBelief b = belief(n, 0.1);
  const auto states = acting_states(d, b);
  ASSERT_GT(states.size(), 500u);
  const WeightedSamples s = sample(d, b, states, 2000);
  EXPECT_NEAR(s.weights.sum(), 1, 1e-9);
  for (Eigen::Index i = 0; i < n; ++i) {
    double part = 0;
    for (Eigen::Index k = 0; k < s.values.cols(); ++k)
      part += s.values(i, k) > 0 ? s.weights[k] : 0;
    EXPECT_NEAR(part, 0.5, 0.05) << i;
  }
}

TEST(ActingSamples, RestAtExactlyZeroAsOftenAsTheStatesSay) {
  std::mt19937 random(5);
  const Matrix rows = random_matrix(6, 4, 10, random);
  const QuadraticDensity d = density(rows, rows * Vector{{0.2, 0, 0.03, 0}});
  RestBelief b = belief(4, 0.1);
  b.slab[3] = 0;  // never rests
  const auto states = acting_states(d, b);
  const WeightedSamples s = sample(d, b, states, 2000);
  EXPECT_NEAR(s.weights.sum(), 1, 1e-9);
  for (Eigen::Index i = 0; i < 4; ++i) {
    double part = 0;
    for (Eigen::Index k = 0; k < s.values.cols(); ++k)
      part += s.values(i, k) > 0 ? s.weights[k] : 0;
    EXPECT_NEAR(part, acts(states, size_t(i)), 1e-9) << i;
  }
  EXPECT_NEAR(acts(states, 3), 1, 1e-9);
}

TEST(ActingSamples, TruthsDrawnFromTheBeliefRankEvenly) {
  // Talts et al. 2018, arXiv:1804.06788: of the truth among samples of its posterior every rank is
  // as likely. Ties at rest are broken at random.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  constexpr Eigen::Index n = 4;
  constexpr int draws = 400, bins = 8;
  const RestBelief b = belief(n, 0.1);
  Vector ranks = Vector::Zero(bins);
  double told = 0, acting = 0;
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<Eigen::Index> order = {0, 1, 2, 3};
    std::shuffle(order.begin(), order.end(), random);
    const auto count = Eigen::Index(uniform(random) * (n + 1));
    const double sd = 0.1 * b.widths[size_t(uniform(random) * double(b.widths.size()))];
    Vector truth = Vector::Zero(n);
    for (Eigen::Index k = 0; k < count; ++k) do
        truth[order[size_t(k)]] = std::abs(sd * normal(random));
      while (truth[order[size_t(k)]] > 1);
    const Matrix rows = random_matrix(5, n, 15, random);
    const QuadraticDensity d = density(rows, rows * truth + random_matrix(5, 1, 1, random));
    const auto states = acting_states(d, b);
    const WeightedSamples s = sample(d, b, states, 200);
    for (Eigen::Index i = 0; i < n; ++i) {
      double below = 0, equal = 0;
      for (Eigen::Index k = 0; k < s.values.cols(); ++k) {
        if (s.values(i, k) < truth[i]) below += s.weights[k];
        if (s.values(i, k) == truth[i]) equal += s.weights[k];
      }
      if (i == draw % n)  // one a draw: those of a draw hang together
        ++ranks[std::min(bins - 1, int(bins * (below + uniform(random) * equal)))];
      told += acts(states, size_t(i)), acting += truth[i] > 0;
    }
  }
  const double expected = double(draws) / bins;
  const double chi2 = (ranks.array() - expected).square().sum() / expected;
  EXPECT_GT(chi_square_tail(chi2, bins - 1), 0.01) << ranks.transpose();
  EXPECT_NEAR(told / (draws * n), acting / (draws * n), 0.03);
}

TEST(Acting, NumbersBeyondThoseOfAComputerGiveAnErrorAndNoPosterior) {
  const double most = std::numeric_limits<double>::infinity();
  const QuadraticDensity density{Matrix::Constant(1, 1, most), Vector::Constant(1, most),
                                 Vector::Zero(1), Vector::Ones(1)};
  EXPECT_THROW(acting_states(density, {Vector::Zero(1), {-1}}), std::runtime_error);
}

}  // namespace
}  // namespace genio
