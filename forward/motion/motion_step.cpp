#include "forward/motion/motion_step.hpp"

namespace genio {

MotionState MotionStep::at(const Vector& u) const {
  MotionState to{from_.time + dt_, u, {}, {}, {}};
  to.a = (u - from_.u - dt_ * from_.v) / (s_.beta * dt_ * dt_) - (0.5 / s_.beta - 1) * from_.a;
  to.v = from_.v + dt_ * ((1 - s_.gamma) * from_.a + s_.gamma * to.a);
  return to;
}

Positions MotionStep::shape(const Vector& u) const {
  return model_.rest + model_.dofs.expand((1 - s_.alpha_f) * u + s_.alpha_f * from_.u);
}

Vector MotionStep::velocity(const MotionState& to) const {
  return model_.dofs.expand((1 - s_.alpha_f) * to.v + s_.alpha_f * from_.v);
}

Vector MotionStep::residual(const Vector& u) {
  const MotionState to = at(u);
  const Positions x = shape(u);
  Forces viscous;
  const Forces f = forces_in_motion(model_, x, velocity(to), p_, viscous);
  viscous_ = model_.dofs.reduce(viscous);
  const Vector a = (1 - s_.alpha_m) * to.a + s_.alpha_m * from_.a;
  return model_.dofs.reduce(f - multiply(mass_, model_.dofs.expand(a))) + viscous_;
}

bool MotionStep::factorize(const Vector& u, Stiffness& scratch, Workspace& ws) const {
  const Positions x = shape(u);
  stiffness(model_, x, p_, ws.stiffness);
  add_damping(model_, x, velocity(at(u)), p_, s_.gamma / (s_.beta * dt_), scratch, ws.stiffness);
  ws.stiffness.add(mass_, (1 - s_.alpha_m) / ((1 - s_.alpha_f) * s_.beta * dt_ * dt_));
  ws.mixed.forget();  // this factor is of no static stiffness
  ws.reduced.assign(ws.stiffness);
  return ws.cholesky.factorize(ws.reduced);
}

}  // namespace genio
