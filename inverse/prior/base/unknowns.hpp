#pragma once
// The unknowns of an inversion: muscle commands, of each side or of both together, and what is
// estimated along with them.

#include <cmath>
#include <string>
#include <vector>

#include "forward/model/model.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {

/// What a part of the head pose moves: the target's points along x or z, or by turning them.
enum class PoseAxis { x, z, turn };

/// One unknown z: a force shared over one or two muscle parameters (z is the activation), another
/// parameter of the model, or a part of the head pose, which moves the target and not the tongue.
struct Unknown {
  enum class Kind { muscle, parameter, pose };

  std::string name;             ///< "GGP" for both sides, "GGP_L" for one
  double scale;                 ///< value at z = 1, or its logarithm: a muscle's maximum force [N]
  std::vector<int> parameters;  ///< model parameter indices
  std::vector<double> shares;   ///< part of the value each gets
  Kind kind = Kind::muscle;
  std::string unit = "N";
  double lower = 0, upper = 1;   ///< of z
  bool ratio = false;            ///< scale z is the value's logarithm
  PoseAxis axis = PoseAxis::x;   ///< of a part of the head pose
  ParameterName parameter = {};  ///< the name in its two parts, of what is no muscle's

  double value(double z) const { return ratio ? std::exp(scale * z) : scale * z; }
  /// d value / dz where it has that value.
  double slope(double value) const { return ratio ? scale * value : scale; }
  /// The z at which it has that value.
  double z_of(double value) const { return (ratio ? std::log(value) : value) / scale; }
};

/// All muscles of the model, in the model's order; `bilateral` joins left and right.
std::vector<Unknown> muscle_unknowns(const Model& model, bool bilateral);

/// Number of the other side of the same muscle for each unknown; -1: none.
std::vector<Eigen::Index> other_sides(const std::vector<Unknown>& unknowns);

/// Model parameters that "effect.parameter" speaks of: itself or its two sides ("weak_muscle.GGP").
/// Throws InputError that suggests the nearest name.
std::vector<int> parameters_named(const Model& model, const std::string& name);

/// The head pose among the unknowns' values; none: no motion.
HeadPose head_pose(const std::vector<Unknown>& unknowns, const Vector& z);
/// d (shift x, shift z, turn) / dz: 3 x count.
Matrix pose_derivative(const std::vector<Unknown>& unknowns);

/// Model parameters with the commands set to `activations` (value over scale).
Parameters apply_unknowns(const std::vector<Unknown>& unknowns, const Vector& activations,
                          Parameters parameters);

}  // namespace genio
