#pragma once
// One time step as an equation; dynamics.cpp solves one after another. Not for other files.

#include "forward/motion/dynamics.hpp"

namespace genio {

/// Displacement, velocity and acceleration of the unknowns.
struct MotionState {
  double time = 0;
  Vector u, v, a;
  Vector viscous;  ///< viscous force of the step that led here, at its instant t_{n+1-alpha_f} [N]
};

/// The equation of motion of one step as a function of the displacement at its end (Chung & Hulbert
/// 1993, J. Appl. Mech. 60, generalised-alpha; Newmark's where alpha_m = alpha_f = 0).
class MotionStep {
 public:
  MotionStep(const Model& model, const NodeMatrix& mass, const TimeScheme& scheme,
             const MotionState& from, double dt, const Parameters& p)
      : model_(model), mass_(mass), s_(scheme), from_(from), dt_(dt), p_(p) {}

  MotionState at(const Vector& u) const;
  /// Where forces are taken.
  Positions shape(const Vector& u) const;
  /// What is unbalanced [N].
  Vector residual(const Vector& u);
  /// The viscous part of the last residual [N].
  const Vector& viscous() const { return viscous_; }
  /// Its derivative, factorised. False where it is not positive definite.
  bool factorize(const Vector& u, Stiffness& scratch, Workspace& ws) const;

 private:
  Vector velocity(const MotionState& to) const;

  const Model& model_;
  const NodeMatrix& mass_;
  const TimeScheme& s_;
  const MotionState& from_;
  double dt_;
  const Parameters& p_;
  Vector viscous_;
};

}  // namespace genio
