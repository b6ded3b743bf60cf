#pragma once
#include "forward/effects/term.hpp"

namespace genio {

/// What stands between the commands and the forces of muscles: a command (the excitation u) is
/// followed by the force that pulls (the activation a) with a delay. It has no energy.
class CommandFilter : public Term {
 public:
  /// The activation [N] a time `dt` [s] after it was `activation`, under a constant `excitation`.
  virtual double follow(double excitation, double activation, double dt,
                        EffectParameters p) const = 0;
  /// Its longest time constant [s].
  virtual double memory(EffectParameters p) const = 0;
};

}  // namespace genio
