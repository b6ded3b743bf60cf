#include "forward/effects/tissue/tissue_potential.hpp"

#include <limits>

namespace genio {

double TissuePotential::energy(const Positions& x, EffectParameters p) const {
  if (!present(p)) return 0;
  double total = 0;
  BatchShape s;
  for (size_t b = 0; b < batches_.size(); ++b) {
    if (!touches(b)) continue;
    if (!deform(batches_[b], x, s)) return std::numeric_limits<double>::infinity();
    total += batch_energy(batches_[b], s, tissue(b, p));
  }
  return total;
}

void TissuePotential::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  if (!present(p)) return;
  BatchShape s;
  for (size_t b = 0; b < batches_.size(); ++b)
    if (touches(b) && deform(batches_[b], x, s)) add_batch_force(batches_[b], s, tissue(b, p), f);
}

void TissuePotential::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  if (!present(p)) return;
  BatchShape s;
  for (size_t b = 0; b < batches_.size(); ++b) {
    if (!touches(b) || !deform(batches_[b], x, s)) continue;
    const BatchTissue t = tissue(b, p);
    add_batch_stiffness(batches_[b], s, t, batch_pressure(batches_[b], s.volume, t), k);
  }
}

void TissuePotential::add_step_stiffness(const Positions& x, const LinearStep& led,
                                         EffectParameters p, Stiffness& k) const {
  if (!present(p)) return;
  BatchShape s;
  for (size_t b = 0; b < batches_.size(); ++b) {
    if (!touches(b) || !deform(batches_[b], x, s)) continue;
    const BatchTissue t = tissue(b, p);
    lanes::Lane pressure = t.kappa;
    for (int l = 0; l < lanes::width; ++l) pressure[l] *= led.dilatation[batches_[b].element[l]];
    add_batch_stiffness(batches_[b], s, t, pressure, k);
  }
}

void TissuePotential::add_bulk_modulus(EffectParameters p, Vector& kappa) const {
  if (!present(p)) return;
  for (size_t b = 0; b < batches_.size(); ++b) {
    if (!touches(b)) continue;
    const BatchTissue t = tissue(b, p);
    for (int l = 0; l < batches_[b].count; ++l) kappa[batches_[b].element[l]] += t.kappa[l];
  }
}

double TissuePotential::volume_step_limit(const Positions& x, const Positions& along) const {
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

void TissuePotential::add_stiffness_product(const Positions& x, const Vector& v, EffectParameters p,
                                            Forces& f) const {
  BatchShape s;
  for (size_t b = 0; b < batches_.size(); ++b)
    if (touches(b) && deform(batches_[b], x, s))
      add_batch_stiffness_product(batches_[b], s, tissue(b, p), v, f);
}

void TissuePotential::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                           Forces& df) const {
  BatchShape s;
  for (size_t b = 0; b < batches_.size(); ++b)
    if (touches(b) && deform(batches_[b], x, s))
      add_batch_force(batches_[b], s, tissue_derivative(b, p, k), df);
}

}  // namespace genio
