#pragma once
// One muscle at rising forces, by large and by small deformation.

#include <map>
#include <string>
#include <vector>

#include "forward/statics/equilibrium.hpp"

namespace genio::bench {

/// Shapes of one muscle at one force. Of those that failed only the message counts.
struct DeformationRow {
  std::string muscle;  ///< of both sides
  double force = 0;    ///< a side: half of what both sides pull with [N]
  Equilibrium large;   ///< of the model as it is
  Equilibrium lone;    ///< of the model without its contacts
  Equilibrium small;   ///< by the linear framework, which no contact stops
  /// What each contact of `large` presses with, where that is 1 % of the muscle's force or more:
  /// the sum of its nodal forces' lengths [N].
  std::map<std::string, double> pressing;
};

/// Names of the muscles, both sides together, in the model's order.
std::vector<std::string> both_sided_muscles(const Model& model);

/// The forces of the comparison up to this maximum, and the maximum itself where it is larger than
/// all of them [N].
std::vector<double> deformation_levels(double maximum);

/// The largest force of a muscle a side [N]. Throws InputError where there is no such muscle.
double maximum_a_side(const Model& model, const std::string& muscle);

/// A model and the same without its contacts, with their workspaces.
class DeformationPair {
 public:
  DeformationPair(const ModelDescription& description, const std::string& source);

  const Model& model() const { return model_; }
  /// A row a level. Each equilibrium starts from that of the level before.
  std::vector<DeformationRow> rows(const std::string& muscle);

 private:
  Model model_, lone_;
  Workspace of_model_, of_lone_;
};

/// How a shape differs from the one that it stands for, over the tongue's own surface by area.
struct ShapeDifference {
  double rms = 0;       ///< [m]
  double largest = 0;   ///< [m]
  double relative = 0;  ///< the root mean square over that of the displacement it stands for
};
ShapeDifference difference(const Model& model, const Positions& large, const Positions& small);

/// What a shape makes of the elements.
struct ElementQuality {
  double volume = 0;  ///< of the mesh over that at rest, less 1
  /// Smallest corner Jacobian over the largest by size, of the worst element: below 0 when folded.
  double least_ratio = 0;
  int folded = 0;  ///< elements with a corner that is inside out
};
ElementQuality element_quality(const Model& model, const Positions& x);

/// The force where a quantity first reaches a bound, along a power law from level to level; 0 where
/// it has the bound at the first level already, infinite where it never has.
double first_reached(const std::vector<double>& forces, const std::vector<double>& values,
                     double bound);

}  // namespace genio::bench
