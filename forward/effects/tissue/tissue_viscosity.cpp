#include "forward/effects/tissue/tissue_viscosity.hpp"

namespace genio {
namespace {

constexpr int beta = 3;  // after a10, a20 and kappa

/// The constants, scaled: the stiffness is linear in them.
std::array<double, 3> scaled(EffectParameters p, double scale) {
  return {scale * p[0], scale * p[1], scale * p[2]};
}

}  // namespace

std::vector<ParameterName> TissueViscosity::borrows() const {
  return {
      {"elasticity", "a10"}, {"elasticity", "a20"}, {"elasticity", "kappa"}, {"viscosity", "beta"}};
}

void TissueViscosity::add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                                        Forces& f) const {
  if (p[beta] != 0) elasticity_->add_stiffness_product(x, v, scaled(p, -p[beta]), f);
}

void TissueViscosity::add_forces(const Positions& x, const Vector& v, EffectParameters p, Forces& f,
                                 Forces& viscous) const {
  if (p[beta] == 0) return elasticity_->add_force(x, p, f);
  const BatchTissue elastic = Elasticity::uniform(p),
                    damping = Elasticity::uniform(scaled(p, -p[beta]));
  BatchShape s;
  for (const ElementBatch& batch : elasticity_->batches()) {
    if (!deform(batch, x, s)) continue;
    add_batch_force(batch, s, elastic, f);
    add_batch_stiffness_product(batch, s, damping, v, viscous);
  }
}

void TissueViscosity::add_damping(const Positions& x, const Vector&, EffectParameters p,
                                  Stiffness& c) const {
  if (p[beta] != 0) elasticity_->add_stiffness(x, scaled(p, p[beta]), c);
}

/// -beta (dK along dx) v = -beta (dK along v) dx, as third derivatives of an energy are symmetric.
void TissueViscosity::add_viscous_force_slope(const Positions& x, const Vector& v,
                                              EffectParameters p, const Matrix& along,
                                              Stiffness& scratch, Matrix& df) const {
  constexpr double longest = 1e-6;  // displacement of a node [m]
  const double size = v.cwiseAbs().maxCoeff();
  if (p[beta] == 0 || size == 0) return;
  const double h = longest / size;
  scratch.set_zero();
  elasticity_->add_stiffness(x + h * v, scaled(p, -p[beta] / (2 * h)), scratch);
  elasticity_->add_stiffness(x - h * v, scaled(p, p[beta] / (2 * h)), scratch);
  df += scratch.multiply_columns(along);
}

void TissueViscosity::add_viscous_force_derivative(const Positions& x, const Vector& v,
                                                   EffectParameters p, int k, Forces& df) const {
  std::array<double, 3> c = scaled(p, -1);
  if (k < beta) c = {}, c[size_t(k)] = -p[beta];
  elasticity_->add_stiffness_product(x, v, c, df);
}

}  // namespace genio
