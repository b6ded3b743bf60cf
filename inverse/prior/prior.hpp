#pragma once
// What is believed of the unknowns before the shape is seen.

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "inverse/prior/unknowns.hpp"

namespace genio {

struct Normal {
  double mean = 0, sd = 1;
};

/// Of a parameter, cut off at bounds of its own within the parameter's.
struct ParameterPrior : Normal {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool ratio = false;  ///< sd is of the parameter's logarithm
};

/// Where head and sensors may have moved against each other, about the target's middle.
struct HeadPosePrior {
  double shift_sd = 0;  ///< along x and z [m]
  double turn_sd = 0;   ///< in the midsagittal plane [rad]
};

/// Beliefs in the terms people have them in; all of them Gaussian, within the muscles' maxima.
/// A muscle is named with or without its side; "GGP" speaks of both.
struct Prior {
  double effort_sd = 0.12;  ///< of every activation about 0, unless EMG says something about it
  std::map<std::string, Normal> emg;    ///< activation of a muscle, as measured
  std::optional<double> symmetry_sd;    ///< of left minus right activation
  std::optional<Normal> cocontraction;  ///< of the mean over all activations
  std::map<std::string, double> fixed;  ///< commands that are known: force [N]
  /// Parameters of effects that are estimated along: "jaw_opening.angle", in their own unit.
  std::map<std::string, ParameterPrior> parameters;
  std::optional<HeadPosePrior> head_pose;
  /// The frame before and how far activations may have walked since.
  struct Before {
    Vector activations;
    double sd = 0.1;
  };
  std::optional<Before> before;
  /// Random walk of activations in a sequence: sd after one second [s^(-1/2)].
  double smoothness_sd = 1.5;
};

/// The unknowns of an inversion under a prior: muscle commands, then the parameters and the head
/// pose that are estimated along. Throws InputError for a name the model has not, naming it.
std::vector<Unknown> unknowns_of(const Model& model, const Prior& prior, bool bilateral);

/// A prior on given unknowns z: 1/2 |A z - b|^2 within bounds.
struct PriorTerms {
  Matrix rows;    ///< A
  Vector values;  ///< b
  Vector lower, upper;

  double value(const Vector& z) const { return 0.5 * (rows * z - values).squaredNorm(); }
  Vector gradient(const Vector& z) const { return rows.transpose() * (rows * z - values); }
  Matrix hessian() const { return rows.transpose() * rows; }
  bool fixed(Eigen::Index i) const { return lower[i] == upper[i]; }
  /// Those that are not fixed.
  std::vector<Eigen::Index> open() const;
};

/// Throws InputError for muscles that are no unknowns, or forces out of bounds.
PriorTerms prior_terms(const Prior& prior, const std::vector<Unknown>& unknowns);

/// The same prior with `times` the standard deviation of effort.
Prior with_effort(Prior prior, double times);

}  // namespace genio
