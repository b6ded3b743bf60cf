#include "forward/effects/tissue/elasticity.hpp"

namespace genio {

namespace {

/// The constants, scaled: the stiffness is linear in them.
std::array<double, 3> scaled(EffectParameters p, double scale) {
  return {scale * p[0], scale * p[1], scale * p[2]};
}

}  // namespace

Elasticity::Elasticity(const HexMesh& mesh, const TissueConstants& c, bool viscous)
    : TissueEffect(mesh),
      viscous_(viscous),
      info_{{{"a10", "Pa", c.a10, 1, 1e6, 0},
             {"a20", "Pa", c.a20, 0, 1e6, 0},
             {"kappa", "Pa", c.kappa, 1e3, 1e10, 0}}} {}

std::vector<std::string> Elasticity::borrows() const {
  if (!viscous_) return {};
  return {"viscosity.beta"};
}

void Elasticity::add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                                   Forces& f) const {
  if (beta(p) != 0) add_stiffness_product(x, v, scaled(p, -beta(p)), f);
}

void Elasticity::add_forces_in_motion(const Positions& x, const Vector& v, EffectParameters p,
                                      Forces& f, Forces& viscous) const {
  if (beta(p) == 0) return add_force(x, p, f);
  const BatchTissue elastic = tissue(0, p), damping = tissue(0, scaled(p, -beta(p)));
  BatchShape s;
  for (const ElementBatch& batch : batches_) {
    if (!deform(batch, x, s)) continue;
    add_batch_force(batch, s, elastic, f);
    add_batch_stiffness_product(batch, s, damping, v, viscous);
  }
}

void Elasticity::add_damping(const Positions& x, const Vector&, EffectParameters p,
                             Stiffness& c) const {
  if (beta(p) != 0) add_stiffness(x, scaled(p, beta(p)), c);
}

/// -beta (dK along dx) v = -beta (dK along v) dx, as third derivatives of an energy are symmetric.
void Elasticity::add_viscous_force_slope(const Positions& x, const Vector& v, EffectParameters p,
                                         const Matrix& along, Stiffness& scratch,
                                         Matrix& df) const {
  constexpr double longest = 1e-6;  // displacement of a node [m]
  const double size = v.cwiseAbs().maxCoeff();
  if (beta(p) == 0 || size == 0) return;
  const double h = longest / size;
  scratch.set_zero();
  add_stiffness(x + h * v, scaled(p, -beta(p) / (2 * h)), scratch);
  add_stiffness(x - h * v, scaled(p, beta(p) / (2 * h)), scratch);
  df += scratch.multiply_columns(along);
}

void Elasticity::add_viscous_force_derivative(const Positions& x, const Vector& v,
                                              EffectParameters p, int k, Forces& df) const {
  if (!viscous_) return;
  std::array<double, 3> c = scaled(p, -1);
  if (k < 3) c = {}, c[size_t(k)] = -beta(p);
  add_stiffness_product(x, v, c, df);
}

double Elasticity::step_limit(const Positions& x, const Positions& along, EffectParameters) const {
  double t = 1.0;
  Positions reached = x + along;
  BatchShape before, after;
  for (size_t b = 0; b < batches_.size(); ++b) {
    const ElementBatch& batch = batches_[b];
    if (!deform(batch, x, before)) continue;
    const auto keeps_volume = [&] {
      if (!deform(batch, reached, after)) return false;
      for (int q = 0; q < 8; ++q)
        if (lanes::any_not_positive(after.j[q] - 0.25 * before.j[q], batch.count)) return false;
      return true;
    };
    while (t > 1e-3 && !keeps_volume()) t *= 0.7, reached = x + t * along;
  }
  return t;
}

}  // namespace genio
