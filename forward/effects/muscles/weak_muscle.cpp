#include "forward/effects/muscles/weak_muscle.hpp"

#include <algorithm>

#include "forward/tissue/segment_forces.hpp"

namespace genio {
namespace {

/// Each muscle of one side, and of both.
std::vector<Variant> sides(std::span<const ParameterInfo> muscles) {
  std::vector<Variant> result;
  for (size_t k = 0; k < muscles.size(); ++k) {
    result.push_back({.where = muscles[k].name, .numbers = {{int(k)}}});
    const std::string both = bilateral_name(muscles[k].name);
    for (size_t j = 0; j < k; ++j)
      if (bilateral_name(muscles[j].name) == both)
        result.push_back({.where = both, .numbers = {{int(j), int(k)}}});
  }
  return result;
}

/// One of the four muscles that are used most, but for SL. Where forces are not known and both
/// sides are commanded alike, only one side can show.
EffectChange hidden_loss(const ChangeDraw& draw) {
  const auto& [tongue, active, forces_known, random] = draw;
  std::uniform_int_distribution<size_t> pick(0, std::min<size_t>(3, active.size() - 1));
  const std::string muscle = active[pick(random)];
  if (muscle == "SL") return hidden_loss(draw);
  const unsigned which = forces_known ? unsigned(random() % 3) : unsigned(random() % 2);
  const auto keys = which == 0   ? std::vector{muscle + "_L"}
                    : which == 1 ? std::vector{muscle + "_R"}
                                 : std::vector{muscle + "_L", muscle + "_R"};
  EffectChange change = change_by_table(
      "weak_muscle",
      [=](double s) {
        EffectTable t;
        for (const auto& key : keys) t[key] = s;
        return t;
      },
      0.3, 1);
  change.where = which == 2 ? muscle : keys.front();
  change.symmetric = which == 2, change.drawn = true;
  return change;
}

}  // namespace

WeakMuscle::WeakMuscle(std::vector<Muscle> muscles, const std::vector<double>& loss)
    : muscles_(std::move(muscles)) {
  for (size_t k = 0; k < muscles_.size(); ++k)
    info_.push_back({.name = muscles_[k].name, .unit = "1", .value = loss[k], .upper = 1});
}

std::vector<ParameterName> WeakMuscle::borrows() const { return command_names(muscles_); }

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

EffectKind weak_muscle_kind() {
  return {.name = "weak_muscle",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            std::vector<double> loss;
            for (const Muscle& m : a.muscles) {
              const std::string both = bilateral_name(m.name);
              const double shared = both == m.name ? 0.0 : s.take(both, 0);
              loss.push_back(s.take(m.name, shared));
            }
            return {.potential = std::make_shared<WeakMuscle>(a.muscles, loss)};
          },
          .belief = {.parameters = {{.typical = 0.4}}, .variants = sides},
          .sample = {{"GGP_L", 0.3}, {"GGP_R", 0.6}},
          .hidden = hidden_loss};
}

}  // namespace genio
