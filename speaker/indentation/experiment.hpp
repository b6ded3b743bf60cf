#pragma once
// What is pressed into which block of tissue.

#include <array>
#include <string>

namespace genio {

/// All are rigid and frictionless, but for the pressure: that is the same at all points of the
/// circle, keeps its direction, and its depth is the mean over the circle.
enum class Indenter { punch, sphere, pressure };

std::string to_string(Indenter indenter);
/// Throws InputError naming the three.
Indenter indenter_of(const std::string& name);

/// The two constants of Yeoh's law [Pa].
struct YeohConstants {
  double a10 = 0, a20 = 0;
};

/// A block that is bonded to a rigid plate below and free at its sides, of which the indenter
/// presses the middle of the top.
struct IndentationExperiment {
  Indenter indenter = Indenter::punch;
  double radius = 5e-3;          ///< of the indenter [m]
  double thickness = 20e-3;      ///< of the block, with its mucosa [m]
  double half_width = 50e-3;     ///< from the axis to a side of the block [m]
  double mucosa = 0;             ///< thickness of the top layer [m]; 0: there is none
  double poisson_ratio = 0.499;  ///< at rest; of both layers
};

/// Throws InputError naming what no experiment has, with what was expected.
void check(const IndentationExperiment& experiment);

/// Bulk modulus over a10 for a Poisson ratio at rest: the shear modulus is 2 a10.
double bulk_over_a10(double poisson_ratio);

}  // namespace genio
