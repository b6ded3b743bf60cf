#include "forward/effects/muscles/weak_muscle.hpp"

#include "forward/tissue/segment_forces.hpp"

namespace genio {

WeakMuscle::WeakMuscle(std::vector<Muscle> muscles, const std::vector<double>& loss)
    : muscles_(std::move(muscles)) {
  for (size_t k = 0; k < muscles_.size(); ++k)
    info_.push_back({muscles_[k].name, "1", loss[k], 0, 1, 0, false, false, 0.4});
}

std::vector<std::string> WeakMuscle::borrows() const { return command_names(muscles_); }

std::vector<Strength> WeakMuscle::strengths() const {
  std::vector<Strength> result;
  for (size_t k = 0; k < muscles_.size(); ++k) {
    result.push_back({muscles_[k].name, {{int(k)}}});
    const std::string both = bilateral_name(muscles_[k].name);
    for (size_t j = 0; j < k; ++j)
      if (bilateral_name(muscles_[j].name) == both) result.push_back({both, {{int(j), int(k)}}});
  }
  return result;
}

double WeakMuscle::energy(const Positions& x, EffectParameters p) const {
  double e = 0;
  for (size_t k = 0, n = muscles_.size(); k < n; ++k)
    if (const double lost = p[k] * p[n + k])
      e -= lost * segment_energy(muscles_[k].segments, x, unit_tension);
  return e;
}

void WeakMuscle::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  for (size_t k = 0, n = muscles_.size(); k < n; ++k)
    if (const double lost = p[k] * p[n + k])
      add_segment_force(muscles_[k].segments, x, -lost, unit_tension, f);
}

void WeakMuscle::add_stiffness(const Positions& x, EffectParameters p, Stiffness& stiffness) const {
  for (size_t k = 0, n = muscles_.size(); k < n; ++k)
    if (const double lost = p[k] * p[n + k])
      add_segment_stiffness(muscles_[k].segments, x, -lost, unit_tension, stiffness);
}

void WeakMuscle::add_force_derivative(const Positions& x, EffectParameters p, int index,
                                      Forces& df) const {
  const size_t n = muscles_.size(), k = size_t(index) % n, other = size_t(index) < n ? n + k : k;
  add_segment_force(muscles_[k].segments, x, -p[other], unit_tension, df);
}

}  // namespace genio
