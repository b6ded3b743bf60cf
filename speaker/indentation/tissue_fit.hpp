#pragma once
// Constants of the tissue from a measured curve of force against depth.

#include <functional>
#include <string>
#include <vector>

#include "speaker/indentation/force_curve.hpp"
#include "speaker/indentation/force_data.hpp"

namespace genio {

struct TissueFitOptions {
  YeohConstants mucosa = {};  ///< where the experiment has one
  bool fit_mucosa = false;    ///< else it is as given; its a20 goes with its a10
  int most_simulations = 60;
  /// Where no scatter is given: the same part of each force, not the same force everywhere.
  bool relative_scatter = false;
  BlockGrid grid = {};
  std::function<void(int simulation, double rms)> progress = {};  ///< rms in newtons
};

/// A constant and what the curve says of it [Pa].
struct FittedConstant {
  std::string name;  ///< "a10", "a20", "mucosa_a10"
  double value, sd;
  double low, high;       ///< of the interval that holds 90 %, within the constant's bounds
  bool at_bound = false;  ///< the curve would rather have it below zero
};

struct TissueFit {
  std::string message;  ///< the reason where there is no answer; empty where there is
  std::vector<FittedConstant> constants;
  Matrix covariance;  ///< of the constants [Pa^2]
  BlockTissue tissue;
  double young_modulus = 0;  ///< of the muscle at rest [Pa]: 6 a10
  double rms = 0;            ///< of the residuals [N]
  double chi2_per_dof = 0;   ///< in standard deviations given; 1 where they are estimated
  double scatter = 0;        ///< estimated, in N or as a part of the force; 0 where it was given
  Vector predicted;          ///< force at each row [N]
  ForceCurve curve;          ///< the equilibria of the answer
  int simulations = 0;       ///< whole curves
  int equilibria = 0, newton_iterations = 0, factorizations = 0;
  double wall_s = 0;

  explicit operator bool() const { return message.empty(); }
};

/// Weighted least squares by sequential quadratic programming (NLopt's SLSQP) in unknowns that the
/// curve at the start makes independent, with exact derivatives. Covariance: the inverse of the
/// Fisher information, with the scatter that is given or, else, that of the residuals.
/// Throws InputError where the experiment cannot have such depths.
TissueFit fit_tissue(const IndentationExperiment& experiment, const ForceData& data,
                     const TissueFitOptions& options);

}  // namespace genio
