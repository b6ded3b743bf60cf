#include "forward/effects/elasticity.hpp"

#include <limits>

#include "forward/effects/yeoh.hpp"

namespace genio {

using lanes::Lane;
using Lane3 = std::array<Lane, 3>;

struct Elasticity::Shape {
  Lane f[8][3][3];          // deformation gradient F at Gauss point q
  Lane inverse_t[8][3][3];  // F^-T
  Lane j[8];                // det F
  Lane j23[8];              // J^(-2/3)
  Lane invariant[8];        // I = J^(-2/3) tr(F^T F)
  Lane volume;              // sum_q w_q J_q [m^3]
};

Elasticity::Elasticity(const HexMesh& mesh, const TissueConstants& c)
    : batches_(element_batches(mesh)),
      info_{{{"a10", "Pa", c.a10, 1, 1e6, 0},
             {"a20", "Pa", c.a20, 0, 1e6, 0},
             {"kappa", "Pa", c.kappa, 1e3, 1e10, 0}}} {}

/// Fills `shape`; false when an element is turned inside out.
bool Elasticity::deform(const Batch& batch, const Positions& x, Shape& s) {
  const auto position = gather(batch, x);
  s.volume = lanes::splat(0);
  for (int q = 0; q < 8; ++q) {
    auto& f = s.f[q];
    gradient(batch, q, position, f);
    auto& c = s.inverse_t[q];  // cofactors first
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        c[i][j] = f[i1][j1] * f[i2][j2] - f[i1][j2] * f[i2][j1];
      }
    s.j[q] = f[0][0] * c[0][0] + f[0][1] * c[0][1] + f[0][2] * c[0][2];
    if (lanes::any_not_positive(s.j[q], batch.count)) return false;
    Lane trace = lanes::splat(0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        c[i][j] /= s.j[q];
        trace += f[i][j] * f[i][j];
      }
    s.j23[q] = lanes::inverse_two_thirds(s.j[q]);
    s.invariant[q] = s.j23[q] * trace;
    s.volume += batch.weight[q] * s.j[q];
  }
  return true;
}

double Elasticity::energy(const Positions& x, EffectParameters p) const {
  const Yeoh<double> law{p[0], p[1]};
  double total = 0;
  Shape s;
  for (const Batch& batch : batches_) {
    if (!deform(batch, x, s)) return std::numeric_limits<double>::infinity();
    for (int l = 0; l < batch.count; ++l) {
      for (int q = 0; q < 8; ++q)
        total += batch.weight[q][l] * law.energy_density(s.invariant[q][l] - 3.0);
      const double dilatation = s.volume[l] / batch.volume[l] - 1.0;
      total += 0.5 * p[2] * batch.volume[l] * dilatation * dilatation;
    }
  }
  return total;
}

void Elasticity::add_force(const Positions& x, EffectParameters p, Forces& force) const {
  const Yeoh<Lane> law{lanes::splat(p[0]), lanes::splat(p[1])};
  Shape s;
  for (const Batch& batch : batches_) {
    if (!deform(batch, x, s)) continue;
    const Lane pressure = p[2] * (s.volume / batch.volume - 1.0);
    Lane3 f[8] = {};
    for (int q = 0; q < 8; ++q) {
      // First Piola stress: P = 2 W' J^(-2/3) F + (p J - 2/3 W' I) F^-T
      const Lane slope = batch.weight[q] * law.slope(s.invariant[q] - 3.0);
      const Lane along_f = 2.0 * slope * s.j23[q];
      const Lane along_inverse =
          batch.weight[q] * pressure * s.j[q] - (2.0 / 3.0) * slope * s.invariant[q];
      for (int i = 0; i < 3; ++i) {
        Lane row[3];
        for (int j = 0; j < 3; ++j)
          row[j] = along_f * s.f[q][i][j] + along_inverse * s.inverse_t[q][i][j];
        for (int a = 0; a < 8; ++a) {
          const auto& g = batch.gradient[q][a];
          f[a][i] -= row[0] * g[0] + row[1] * g[1] + row[2] * g[2];
        }
      }
    }
    for (int a = 0; a < 8; ++a)
      for (int l = 0; l < batch.count; ++l)
        for (int i = 0; i < 3; ++i) force[3 * batch.node[a][l] + i] += f[a][i][l];
  }
}

void Elasticity::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  Shape s;
  for (const Batch& batch : batches_)
    if (deform(batch, x, s))
      add_batch_stiffness(batch, s, p[2] * (s.volume / batch.volume - 1.0), p, k);
}

void Elasticity::add_step_stiffness(const Positions& x, const Positions& previous,
                                    const Vector& step, EffectParameters p, Stiffness& k) const {
  Shape s;
  for (const Batch& batch : batches_)
    if (deform(batch, x, s))
      add_batch_stiffness(
          batch, s, p[2] * (predicted_volume(batch, previous, step) / batch.volume - 1.0), p, k);
}

/// Volume after `step` as the linearisation at `from` predicts it [m^3].
Lane Elasticity::predicted_volume(const Batch& batch, const Positions& from, const Vector& step) {
  Shape s;
  deform(batch, from, s);
  Lane volume = s.volume;
  const auto moved = gather(batch, step);
  for (int q = 0; q < 8; ++q) {
    const Lane w = batch.weight[q] * s.j[q];
    for (int a = 0; a < 8; ++a) {
      const auto& d = batch.gradient[q][a];
      for (int i = 0; i < 3; ++i)
        volume += w * moved[a][i] *
                  (s.inverse_t[q][i][0] * d[0] + s.inverse_t[q][i][1] * d[1] +
                   s.inverse_t[q][i][2] * d[2]);
    }
  }
  return volume;
}

void Elasticity::add_batch_stiffness(const Batch& batch, const Shape& s, Lane pressure,
                                     EffectParameters p, Stiffness& k) {
  const Yeoh<Lane> law{lanes::splat(p[0]), lanes::splat(p[1])};
  Lane block[36][9] = {};
  Lane3 dv[8] = {};  // dv/dx_a
  for (int q = 0; q < 8; ++q) {
    const Lane w = batch.weight[q];
    const Lane slope = law.slope(s.invariant[q] - 3.0);
    const Lane invariant = s.invariant[q], j23 = s.j23[q];
    Lane3 f[8], g[8];  // F dN_a/dX and F^-T dN_a/dX = dN_a/dx
    for (int a = 0; a < 8; ++a) {
      const auto& d = batch.gradient[q][a];
      for (int i = 0; i < 3; ++i) {
        f[a][i] = s.f[q][i][0] * d[0] + s.f[q][i][1] * d[1] + s.f[q][i][2] * d[2];
        g[a][i] =
            s.inverse_t[q][i][0] * d[0] + s.inverse_t[q][i][1] * d[1] + s.inverse_t[q][i][2] * d[2];
        dv[a][i] += w * s.j[q] * g[a][i];
      }
    }
    // d2W(I)/dF2 contracted with the gradients: W' d2I + W'' dI dI, with
    // dI_a = 2 J^(-2/3) f_a - 2/3 I g_a; the mean dilatation adds p J (g_a g_b - g_b g_a).
    const Lane curvature = law.curvature();
    const Lane ff = w * curvature * 4.0 * j23 * j23;
    const Lane fg = w * (-4.0 / 3.0) * j23 * (slope + curvature * invariant);
    const Lane bulk = w * pressure * s.j[q];
    const Lane gg = w * (4.0 / 9.0) * invariant * (slope + curvature * invariant) + bulk;
    const Lane swapped = w * (2.0 / 3.0) * slope * invariant - bulk;
    const Lane unit = w * 2.0 * slope * j23;
    for (int b = 0; b < 8; ++b) {
      Lane3 pf, pg, pt;
      for (int i = 0; i < 3; ++i) {
        pf[i] = ff * f[b][i] + fg * g[b][i];
        pg[i] = fg * f[b][i] + gg * g[b][i];
        pt[i] = swapped * g[b][i];
      }
      const auto& db = batch.gradient[q][b];
      for (int a = b; a < 8; ++a) {
        Lane* out = block[a * (a + 1) / 2 + b];
        const auto& da = batch.gradient[q][a];
        const Lane dot = unit * (da[0] * db[0] + da[1] * db[1] + da[2] * db[2]);
        for (int i = 0; i < 3; ++i) {
          for (int m = 0; m < 3; ++m)
            out[3 * i + m] += f[a][i] * pf[m] + g[a][i] * pg[m] + pt[i] * g[a][m];
          out[4 * i] += dot;
        }
      }
    }
  }
  const Lane stiff = p[2] / batch.volume;
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b <= a; ++b)
      for (int i = 0; i < 3; ++i)
        for (int m = 0; m < 3; ++m)
          block[a * (a + 1) / 2 + b][3 * i + m] += stiff * dv[a][i] * dv[b][m];
  for (int l = 0; l < batch.count; ++l) {
    const auto& slots = k.pattern().element_slots(batch.element[l]);
    for (int pair = 0; pair < 36; ++pair) {
      const int slot = slots[pair];
      if (slot >= 0) {
        double* v = k.block(slot);
        for (int i = 0; i < 9; ++i) v[i] += block[pair][i][l];
      } else {
        double* v = k.block(~slot);
        for (int i = 0; i < 3; ++i)
          for (int m = 0; m < 3; ++m) v[3 * i + m] += block[pair][3 * m + i][l];
      }
    }
  }
}

double Elasticity::step_limit(const Positions& x, const Positions& along) const {
  double t = 1.0;
  Shape before, after;
  for (const Batch& batch : batches_) {
    if (!deform(batch, x, before)) continue;
    const auto keeps_volume = [&] {
      if (!deform(batch, x + t * along, after)) return false;
      for (int q = 0; q < 8; ++q)
        if (lanes::any_not_positive(after.j[q] - 0.25 * before.j[q], batch.count)) return false;
      return true;
    };
    while (t > 1e-3 && !keeps_volume()) t *= 0.7;
  }
  return t;
}

void Elasticity::add_force_derivative(const Positions& x, EffectParameters, int k,
                                      Forces& df) const {
  const double unit[3] = {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
  add_force(x, unit, df);  // the force is linear in each constant
}

}  // namespace genio
