#include "discrepancy/shared/shared_fit.hpp"

#include <algorithm>
#include <cmath>

#include "discrepancy/contest/settled_fit.hpp"

namespace genio {
namespace {

/// Of the points of all conditions [m].
double rms_of(const JointFit& fit, double noise) {
  const Vector r = fit.residuals();
  return noise * std::sqrt(r.squaredNorm() / double(std::max<Eigen::Index>(1, r.size())));
}

}  // namespace

SharedFit fit_shared(const ModelDescription& description, const Observations& observations,
                     const SharedPrior& shared, const ErrorModel& error_model) {
  ConditionSet set(description, observations, fitted_conditions(observations));
  const JointFit alone = fit(set, {}, nullptr, {.precision = rough_precision});
  expect_all(set, alone);
  FitOptions options;
  options.start = alone.conditions, options.precision = rough_precision;
  for (const auto& [name, belief] : shared.parameters) options.shared_start[name] = belief.mean;
  JointFit first = fit(set, shared, nullptr, options);
  expect_all(set, first);
  const SettledFit s = settled(set, shared, {std::move(first), nullptr, nullptr}, error_model);

  SharedFit result{
      s.fit, {}, {}, {}, rms_of(alone, observations.noise), rms_of(s.fit, observations.noise)};
  const Matrix j = s.errors->covariance.matrixL().solve(s.fit.jacobian());
  const Matrix& rows = s.fit.prior_rows;
  const Matrix all = (j.transpose() * j + rows.transpose() * rows)
                         .llt()
                         .solve(Matrix::Identity(s.fit.u.size(), s.fit.u.size()));
  const FittedCondition& c = s.fit.conditions.front();
  std::vector<int> at;
  std::vector<double> value, slope;
  for (size_t i = 0; i < c.unknowns.size(); ++i) {
    const Unknown& unknown = c.unknowns[i];
    if (c.which[i] < s.fit.own || !shared.parameters.contains(unknown.parameter)) continue;
    result.names.push_back(unknown.parameter);
    at.push_back(c.which[i]);
    value.push_back(unknown.value(c.z[Eigen::Index(i)]));
    slope.push_back(unknown.slope(value.back()));
  }
  result.values = Eigen::Map<const Vector>(value.data(), Eigen::Index(value.size()));
  const Eigen::Map<const Vector> by(slope.data(), Eigen::Index(slope.size()));
  result.covariance = by.asDiagonal() * all(at, at) * by.asDiagonal();
  return result;
}

}  // namespace genio
