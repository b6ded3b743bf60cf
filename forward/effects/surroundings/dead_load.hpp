#pragma once
#include <array>
#include <string>

#include "forward/effects/potential.hpp"

namespace genio {

/// Forces that keep their direction: E = -p sum_a w_a . x_a with nodal weights w that the caller
/// gives, for verification problems. Parameter "force": p [N].
class DeadLoad final : public Potential {
 public:
  /// `weights`: 3 n, newtons on each node per newton of the parameter.
  DeadLoad(std::string name, Forces weights, double force);

  std::string_view name() const override { return name_; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override {
    return -p[0] * weights_.dot(x);
  }
  void add_force(const Positions&, EffectParameters p, Forces& f) const override {
    f += p[0] * weights_;
  }
  void add_stiffness(const Positions&, EffectParameters, Stiffness&) const override {}
  void add_force_derivative(const Positions&, EffectParameters, int, Forces& df) const override {
    df += weights_;
  }

 private:
  std::string name_;
  Forces weights_;
  std::array<ParameterInfo, 1> info_;
};

}  // namespace genio
