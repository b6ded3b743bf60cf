#pragma once
// An effect of the model file, as its kind makes it.

#include <memory>
#include <string_view>
#include <vector>

#include "forward/effects/command_filter.hpp"
#include "forward/effects/contact_potential.hpp"
#include "forward/effects/dissipation.hpp"
#include "forward/effects/inertia.hpp"
#include "forward/effects/joint_forces.hpp"
#include "forward/effects/potential.hpp"

namespace genio {

/// What an effect adds to a model: to its energy, to its dissipation, to its mass, between
/// commands and forces, or to the shape of its rest configuration. At least one term is there, and
/// all terms have the effect's name.
struct Effect {
  std::shared_ptr<const Potential> potential = nullptr;
  std::shared_ptr<const Dissipation> dissipation = nullptr;
  std::shared_ptr<const Inertia> inertia = nullptr;
  std::shared_ptr<const CommandFilter> filter = nullptr;
  std::shared_ptr<const Term> modes = nullptr;
  /// Force of potential and dissipation at once, where they can share work.
  std::shared_ptr<const JointForces> joint = nullptr;
  /// The potential as a contact, where it is one.
  std::shared_ptr<const ContactPotential> contact = nullptr;
  /// True where its parameters are the commands of muscles.
  bool commands = false;

  std::string_view name() const;
  /// Of all its terms, in the order above.
  std::vector<ParameterInfo> parameters() const;
  /// Its terms, in the order above.
  std::vector<const Term*> terms() const;
};

}  // namespace genio
