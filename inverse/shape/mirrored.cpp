#include "inverse/shape/mirrored.hpp"

#include <algorithm>
#include <cmath>

#include "inverse/posterior/posterior.hpp"

namespace genio {
namespace {

constexpr double unlike = 0.01;    // activations of two sides that are not the same
constexpr double well_told = 3.5;  // a rise that leaves the mirror image 3 %

}  // namespace

std::optional<double> mix_mirrored(Objective& objective, const ObjectivePoint& optimum,
                                   ActingPosterior& posterior) {
  auto other = other_sides(objective.unknowns());
  for (size_t i = 0; i < other.size(); ++i)
    if (other[i] < 0) other[i] = Eigen::Index(i);
  const PriorTerms& prior = objective.prior();
  const Vector& z = optimum.activations;
  const Vector mirrored = z(other);
  if ((mirrored - z).cwiseAbs().maxCoeff() < unlike) return std::nullopt;
  for (Eigen::Index i = 0; i < z.size(); ++i)
    if (mirrored[i] != z[i] &&
        (prior.fixed(i) || mirrored[i] < prior.lower[i] || mirrored[i] > prior.upper[i]))
      return std::nullopt;
  const ObjectivePoint* there = objective.at(mirrored);
  if (!there || there->value - optimum.value > well_told) return std::nullopt;
  const double share = 1 / (1 + std::exp(there->value - optimum.value));
  std::vector<Eigen::Index> row(posterior.which.size());  // of the other side among the samples
  for (size_t f = 0; f < row.size(); ++f)
    row[f] = std::find(posterior.which.begin(), posterior.which.end(),
                       other[size_t(posterior.which[f])]) -
             posterior.which.begin();
  auto& [values, weights] = posterior.samples;
  const Matrix exchanged = values(row, Eigen::all);
  values = (Matrix(values.rows(), 2 * values.cols()) << values, exchanged).finished();
  weights = (Vector(2 * weights.size()) << (1 - share) * weights, share * weights).finished();
  return share;
}

}  // namespace genio
