#pragma once
// What the batteries of laws share: the small model with every effect, a shape in which each does
// something, and derivatives by differences. A difference quotient's error falls with the step,
// then rises with rounding: a V.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "forward/model/build_model.hpp"
#include "forward/model/effect_kinds.hpp"
#include "forward/model/sums.hpp"
#include "tests/forward/small_model.hpp"

namespace genio::test {

/// Relative errors of central differences for steps 1e-3 ... 1e-9.
template <class Error>
std::vector<double> errors_over_steps(Error error) {
  std::vector<double> e;
  for (double h = 1e-3; h > 5e-10; h /= 10) e.push_back(error(h));
  return e;
}

inline void expect_v(const std::vector<double>& e, double bottom) {
  const double best = *std::min_element(e.begin(), e.end());
  EXPECT_LT(best, bottom);
  // Falls before and rises after, unless the function is linear or quadratic and rounding is all.
  if (e.front() > 1e-7) {
    EXPECT_LT(e[1], 0.2 * e.front());
  }
  EXPECT_GT(e.back(), best);
}

/// Names of the effects that have such a term.
template <class T>
std::vector<std::string> names_with(const std::vector<Placed<T>>& terms) {
  std::vector<std::string> names;
  for (const auto& term : terms) names.emplace_back(term->name());
  return names;
}

/// Laws of one term of an effect, by the effect's name.
template <class T>
class TermLaw : public testing::TestWithParam<std::string> {
 protected:
  explicit TermLaw(const std::vector<Placed<T>> Model::*terms)
      : model(build_model(with_every_effect(), "block")),
        term(find(model.*terms, GetParam())),
        kind(*find_kind(GetParam())),
        p(default_parameters(model)) {
    set_command(model, "GGP_L", 0.2, p);
    set_command(model, "GGP_R", 0.1, p);
    values = term.values(p);
    x = shaken(model, 4e-4, 3);
    for (int a = 0; a < int(model.mesh.nodes.size()); ++a) {
      x[3 * a + 2] += 1.6e-3;  // some touch
      if (model.mesh.nodes[size_t(a)][0] < 2e-3) x[3 * a] -= 1.4e-3;
    }
    direction = shaken(model, 1.0, 11) - model.rest;
    direction *= 3e-2 / direction.norm();
    velocity = 20 * (shaken(model, 4e-3, 17) - model.rest);
  }

  static const Placed<T>& find(const std::vector<Placed<T>>& terms, const std::string& name) {
    return *std::find_if(terms.begin(), terms.end(),
                         [&](const auto& t) { return t->name() == name; });
  }

  /// The stiffness against differences of force(h), the force a step h along the direction.
  template <class ForceAfter>
  void expect_stiffness(const Stiffness& k, ForceAfter force) const {
    const Vector exact = k.multiply(direction);
    const double scale = exact.norm();
    ASSERT_GT(scale, 0);
    expect_v(errors_over_steps([&](double h) {
               return ((force(-h) - force(h)) / (2 * h) - exact).norm() / scale;
             }),
             1e-6);
    const Vector other = shaken(model, 1.0, 23) - model.rest;
    EXPECT_NEAR(other.dot(exact), direction.dot(k.multiply(other)), 1e-12 * scale * other.norm());
  }

  /// d force / d parameter k against differences, for every own and borrowed parameter.
  template <class Derivative, class Force>
  void expect_parameter_derivatives(Derivative derivative, Force force) {
    for (size_t k = 0; k < values.size(); ++k) {
      Forces exact = Forces::Zero(x.size());
      derivative(int(k), exact);
      std::vector<double> up = values, down = values;
      const double h = values[k] != 0 ? 1e-4 * std::abs(values[k]) : 1e-6;
      up[k] += h, down[k] -= h;
      Forces plus = Forces::Zero(x.size()), minus = plus;
      force(up, plus);
      force(down, minus);
      EXPECT_LE(((plus - minus) / (2 * h) - exact).norm(), 1e-6 * std::max(exact.norm(), 1e-9))
          << "parameter " << k;
    }
  }

  /// All parameters of the effect at the values where it vanishes.
  std::vector<double> absent_values() const {
    Parameters absent = p;
    for (size_t k = 0; k < model.parameters.size(); ++k)
      if (const ParameterSlot& slot = model.parameters[k]; slot.effect == term.effect)
        absent[Eigen::Index(k)] = slot.info.absent;
    return term.values(absent);
  }

  const Model model;
  const Placed<T>& term;
  const EffectKind& kind;
  Parameters p;
  std::vector<double> values;
  Positions x;
  Vector direction, velocity;
};

}  // namespace genio::test
