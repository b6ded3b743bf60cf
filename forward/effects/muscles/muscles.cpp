#include "forward/effects/muscles/muscles.hpp"

#include "forward/tissue/segment_forces.hpp"

namespace genio {

Muscles::Muscles(std::vector<Muscle> muscles) : muscles_(std::move(muscles)) {
  for (const Muscle& m : muscles_)
    info_.push_back({.name = m.name, .unit = "N", .upper = m.max_force, .load = true});
}

double Muscles::energy(const Positions& x, EffectParameters p) const {
  double e = 0;
  for (size_t k = 0; k < muscles_.size(); ++k)
    if (p[k] != 0) e += p[k] * segment_energy(muscles_[k].segments, x, unit_tension);
  return e;
}

void Muscles::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  for (size_t k = 0; k < muscles_.size(); ++k)
    if (p[k] != 0) add_segment_force(muscles_[k].segments, x, p[k], unit_tension, f);
}

void Muscles::add_force_derivative(const Positions& x, EffectParameters, int k, Forces& df) const {
  add_segment_force(muscles_[size_t(k)].segments, x, 1.0, unit_tension, df);
}

void Muscles::add_stiffness(const Positions& x, EffectParameters p, Stiffness& stiffness) const {
  for (size_t k = 0; k < muscles_.size(); ++k)
    if (p[k] != 0) add_segment_stiffness(muscles_[k].segments, x, p[k], unit_tension, stiffness);
}

std::vector<std::pair<int, int>> Muscles::couplings() const { return segment_couplings(muscles_); }

Effect muscle_commands(std::vector<Muscle> muscles) {
  return {.potential = std::make_shared<Muscles>(std::move(muscles)), .commands = true};
}

EffectKind muscles_kind() {
  return {.name = "muscles",
          .make = [](Settings&, const Anatomy& a) { return muscle_commands(a.muscles); },
          .always = true};
}

}  // namespace genio
