#include "forward/effects/muscles/force_length.hpp"

#include <cmath>
#include <numbers>

#include "forward/tissue/segment_forces.hpp"

namespace genio {
namespace {

/// f - 1 with its derivatives by lambda, width and optimum.
struct Falloff {
  double value, by_lambda, by_width, by_optimum;
  Falloff(double lambda, double width, double optimum) {
    const double u = (lambda - optimum) / width, f = std::exp(-u * u);
    value = f - 1, by_lambda = -2 * u / width * f, by_width = 2 * u * u / width * f;
    by_optimum = -by_lambda;
  }
};

/// Integral of f - 1 over lambda from the optimum.
double integral(double lambda, double width, double optimum) {
  return 0.5 * width * std::sqrt(std::numbers::pi) * std::erf((lambda - optimum) / width) -
         (lambda - optimum);
}

double rest_length(const FibreSegment& s) { return s.short_length / shortest_fibre; }

/// The integral of (f - 1) phi' over L, where phi is unit_tension; phi' is 1 above short_length,
/// and below it the integral is taken by five Gauss points.
LengthEnergy energy_of(const FibreSegment& s, double length, double width, double optimum) {
  const double rest = rest_length(s);
  const auto slope = [&](double l) {
    return Falloff(l / rest, width, optimum).value * unit_tension(s, l).slope_over_length * l;
  };
  const LengthEnergy tension = unit_tension(s, length);
  const Falloff f(length / rest, width, optimum);
  LengthEnergy e{
      rest * integral(std::max(length, s.short_length) / rest, width, optimum),
      f.value * tension.slope_over_length,
      f.by_lambda / rest * tension.slope_over_length * length + f.value * tension.curvature};
  if (length < s.short_length) {
    constexpr double at[5] = {-0.906179845938664, -0.538469310105683, 0, 0.538469310105683,
                              0.906179845938664};
    constexpr double weight[5] = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                  0.478628670499366, 0.236926885056189};
    const double half = 0.5 * (s.short_length - length), mid = 0.5 * (s.short_length + length);
    for (int i = 0; i < 5; ++i) e.value -= weight[i] * half * slope(mid + half * at[i]);
  }
  return e;
}

}  // namespace

ForceLength::ForceLength(std::vector<Muscle> muscles, double strength, double width, double optimum)
    : muscles_(std::move(muscles)),
      info_{{{.name = "strength", .unit = "1", .value = strength, .lower = 0, .upper = 1},
             {.name = "width",
              .unit = "1",
              .value = width,
              .lower = 0.05,
              .upper = 5,
              .absent = width},
             {.name = "optimum",
              .unit = "1",
              .value = optimum,
              .lower = 0.3,
              .upper = 2,
              .absent = optimum}}} {}

std::vector<ParameterName> ForceLength::borrows() const { return command_names(muscles_); }

double ForceLength::energy(const Positions& x, EffectParameters p) const {
  if (p[0] == 0) return 0;
  double e = 0;
  for (size_t k = 0; k < muscles_.size(); ++k)
    if (const double tension = p[3 + k])
      e += p[0] * tension * segment_energy(muscles_[k].segments, x, [&](const auto& s, double l) {
             return energy_of(s, l, p[1], p[2]);
           });
  return e;
}

void ForceLength::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  if (p[0] == 0) return;
  for (size_t k = 0; k < muscles_.size(); ++k)
    if (const double tension = p[3 + k])
      add_segment_force(
          muscles_[k].segments, x, p[0] * tension,
          [&](const auto& s, double l) { return energy_of(s, l, p[1], p[2]); }, f);
}

void ForceLength::add_stiffness(const Positions& x, EffectParameters p,
                                Stiffness& stiffness) const {
  if (p[0] == 0) return;
  for (size_t k = 0; k < muscles_.size(); ++k)
    if (const double tension = p[3 + k])
      add_segment_stiffness(
          muscles_[k].segments, x, p[0] * tension,
          [&](const auto& s, double l) { return energy_of(s, l, p[1], p[2]); }, stiffness);
}

void ForceLength::add_force_derivative(const Positions& x, EffectParameters p, int index,
                                       Forces& df) const {
  const auto slope = [&](const FibreSegment& s, double l) {
    const Falloff f(l / rest_length(s), p[1], p[2]);
    const double by = index == 1 ? f.by_width : index == 2 ? f.by_optimum : f.value;
    return LengthEnergy{0, by * unit_tension(s, l).slope_over_length, 0};
  };
  for (size_t k = 0; k < muscles_.size(); ++k) {
    double scale = p[3 + k];
    if (index == 1 || index == 2) scale *= p[0];
    if (index >= 3) scale = index == int(3 + k) ? p[0] : 0.0;
    if (scale != 0) add_segment_force(muscles_[k].segments, x, scale, slope, df);
  }
}

EffectKind force_length_kind() {
  return {
      .name = "force_length",
      .make = [](Settings& s, const Anatomy& a) -> Effect {
        const double strength = s.take("strength", 1), width = s.take("width", 0.67),
                     optimum = s.take("optimum", 1);
        return {.potential = std::make_shared<ForceLength>(a.muscles, strength, width, optimum)};
      },
      .belief = {.parameters = {{.parameter = "strength", .typical = 1}}},
      .sample = {{"strength", 0.7}, {"width", 0.5}, {"optimum", 1.1}},
      .hidden =
          [](const ChangeDraw&) {
            return change_by_number(
                "force_length",
                {.key = "strength", .absent = 0, .unit = 1, .first = 0.5, .most = 1});
          }};
}

}  // namespace genio
