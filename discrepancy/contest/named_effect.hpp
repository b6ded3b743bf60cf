#pragma once
// Effects that a discovery names, with intervals that hold what the error model leaves open.

#include <string>
#include <vector>

#include "discrepancy/candidates/score.hpp"
#include "discrepancy/errors/error_model.hpp"

namespace genio {

/// An effect that the data call for.
struct NamedEffect {
  std::string effect, where;
  std::vector<SharedEstimate> parameters;  ///< "stiff_region.factor" and so on
  double confidence = 0;                   ///< probability among all models tried
};

/// An estimate whose number says what an effect does only up to a standard deviation of `more`, in
/// the terms of its typical value. What can be on one side of `absent` only is log-normal above.
SharedEstimate widened(SharedEstimate estimate, const FreeNumber& number, double more);

/// The effects found, one after another, with their parameters as fitted and widened: a unit of an
/// effect does its work only up to a part, as a newton of a muscle does (their course and the
/// tissue about them are not the model's), and a place is found as well as the mesh lets it be.
std::vector<NamedEffect> named(const JointFit& fit, const std::vector<Candidate>& found,
                               const std::vector<double>& confidence,
                               const ErrorModel& error_model);

}  // namespace genio
