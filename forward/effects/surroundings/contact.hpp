#pragma once
#include <array>
#include <memory>
#include <string>

#include "forward/effects/contact_potential.hpp"
#include "forward/effects/newton_aid.hpp"
#include "forward/effects/surroundings/contact_surface.hpp"

namespace genio {

/// Penalty contact with a rigid surface.
///
/// E = sum_q A_q k phi(g_q) over points q of the tongue's faces, g_q = distance(x_q) - clearance_q,
/// phi(g) = 0 for g >= 0. The spring is contact_spring(): it sets in softly and hardens, and force
/// and stiffness are continuous. A surface that belongs to an opening jaw moves with it.
/// Parameter: stiffness k [Pa/m], pressure per depth.
class Contact final : public ContactPotential, public NewtonAid {
 public:
  /// `of_bone`: the displacements of the surface's vertices in a mode of anatomy.
  Contact(std::string name, std::shared_ptr<const ContactSurface> surface, double stiffness,
          std::vector<Vec3> AnatomyMode::*of_bone = &AnatomyMode::palate);

  std::string_view name() const override { return name_; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  std::vector<ParameterName> borrows() const override { return surface_->borrows(); }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

  const NewtonAid* newton_aid() const override { return this; }
  /// The surface's curvature enters with the force that the linearisation predicted for x: a
  /// straight step overshoots, and the force of its deep penetration is no guide.
  void add_step_stiffness(const Positions& x, const LinearStep& led, EffectParameters p,
                          Stiffness& k) const override;
  /// No node goes deeper than 4 mm in one step, unless it is deeper already.
  double step_limit(const Positions& x, const Positions& along, EffectParameters p) const override;

  double distance(const Vec3& point) const override {
    return surface_->touchable->field->exact().face()(point);
  }
  double max_penetration(const Positions& x, EffectParameters p) const override;
  void add_force_along(const Positions& x, EffectParameters p, const Positions& rest,
                       std::span<const AnatomyMode* const> modes, Matrix& df) const override;

 private:
  std::string name_;
  std::shared_ptr<const ContactSurface> surface_;
  std::array<ParameterInfo, 1> info_;
  std::vector<Vec3> AnatomyMode::*of_bone_;
};

}  // namespace genio
