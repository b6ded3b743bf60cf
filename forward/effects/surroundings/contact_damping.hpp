#pragma once
#include <array>
#include <memory>
#include <string>

#include "forward/effects/dissipation.hpp"
#include "forward/effects/surroundings/contact_surface.hpp"

namespace genio {

/// A contact's spring, damped in motion (the seed model's; after Hunt & Crossley 1975): the normal
/// force becomes k phi' (1 + damping * rate of the depth), by the depth that the spring has.
/// Parameter: damping [s/m]. It borrows the contact's stiffness [Pa/m] and the jaw's motion where
/// the surface belongs to it.
class ContactDamping final : public Dissipation {
 public:
  /// `name`: the contact's.
  ContactDamping(std::string name, std::shared_ptr<const ContactSurface> surface, double damping);

  std::string_view name() const override { return name_; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  std::vector<ParameterName> borrows() const override;
  void add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                         Forces& f) const override;
  void add_damping(const Positions& x, const Vector& v, EffectParameters p,
                   Stiffness& c) const override;
  void add_viscous_force_slope(const Positions& x, const Vector& v, EffectParameters p,
                               const Matrix& along, Stiffness& scratch, Matrix& df) const override;
  void add_viscous_force_derivative(const Positions& x, const Vector& v, EffectParameters p, int k,
                                    Forces& df) const override;

 private:
  std::string name_;
  std::shared_ptr<const ContactSurface> surface_;
  std::array<ParameterInfo, 1> info_;
};

}  // namespace genio
