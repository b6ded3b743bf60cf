#include "forward/tissue/tissue.hpp"

namespace genio {

using lanes::Lane;
using Lane3 = std::array<Lane, 3>;

namespace {

/// d2W(I)/dF2 and the pressure's geometric part at Gauss point q, contracted with gradients:
/// W' d2I + W'' dI dI with dI_a = 2 J^(-2/3) f_a - 2/3 I g_a, f_a = F dN_a/dX, g_a = dN_a/dx; the
/// mean dilatation adds p J (g_a g_b - g_b g_a).
struct Curvature {
  Lane ff, fg, gg, swapped, unit;

  Curvature(const BatchShape& s, int q, Lane w, const BatchTissue& tissue, Lane pressure) {
    const Lane invariant = s.invariant[q], j23 = s.j23[q];
    const Lane slope = tissue.law[q].slope(invariant - 3.0);
    const Lane curvature = tissue.law[q].curvature(invariant - 3.0);
    const Lane bulk = w * pressure * s.j[q];
    ff = w * curvature * 4.0 * j23 * j23;
    fg = w * (-4.0 / 3.0) * j23 * (slope + curvature * invariant);
    gg = w * (4.0 / 9.0) * invariant * (slope + curvature * invariant) + bulk;
    swapped = w * (2.0 / 3.0) * slope * invariant - bulk;
    unit = w * 2.0 * slope * j23;
  }
};

void scatter(const ElementBatch& batch, const Lane3 (&f)[8], Forces& force) {
  for (int a = 0; a < 8; ++a)
    for (int l = 0; l < batch.count; ++l)
      for (int i = 0; i < 3; ++i) force[3 * batch.node[a][l] + i] += f[a][i][l];
}

}  // namespace

BatchTissue BatchTissue::uniform(double a10, double a20, double a30, double kappa) {
  BatchTissue t;
  t.law.fill({lanes::splat(a10), lanes::splat(a20), lanes::splat(a30)});
  t.kappa = lanes::splat(kappa);
  return t;
}

bool deform(const ElementBatch& batch, const Positions& x, BatchShape& s) {
  const auto position = gather(batch, x);
  s.volume = lanes::splat(0);
  for (int q = 0; q < 8; ++q) {
    auto& f = s.f[q];
    gradient(batch, q, position, f);
    auto& c = s.inverse_t[q];
    lanes::cofactors(f, c);
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

double batch_energy(const ElementBatch& batch, const BatchShape& s, const BatchTissue& tissue) {
  const Lane dilatation = s.volume / batch.volume - 1.0;
  Lane e = 0.5 * tissue.kappa * batch.volume * dilatation * dilatation;
  for (int q = 0; q < 8; ++q)
    e += batch.weight[q] * tissue.law[q].energy_density(s.invariant[q] - 3.0);
  double total = 0;
  for (int l = 0; l < batch.count; ++l) total += e[l];
  return total;
}

void add_batch_force(const ElementBatch& batch, const BatchShape& s, const BatchTissue& tissue,
                     Forces& force) {
  const Lane pressure = batch_pressure(batch, s.volume, tissue);
  Lane3 f[8] = {};
  for (int q = 0; q < 8; ++q) {
    // First Piola stress: P = 2 W' J^(-2/3) F + (p J - 2/3 W' I) F^-T
    const Lane slope = batch.weight[q] * tissue.law[q].slope(s.invariant[q] - 3.0);
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
  scatter(batch, f, force);
}

void add_batch_stiffness_product(const ElementBatch& batch, const BatchShape& s,
                                 const BatchTissue& tissue, const Vector& v, Forces& product) {
  const auto moved = gather(batch, v);
  const Lane pressure = batch_pressure(batch, s.volume, tissue);
  Lane rate[8][3][3], trace[8];  // grad v, F^-T : grad v
  Lane swelling = lanes::splat(0);
  for (int q = 0; q < 8; ++q) {
    gradient(batch, q, moved, rate[q]);
    trace[q] = lanes::splat(0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) trace[q] += s.inverse_t[q][i][j] * rate[q][i][j];
    swelling += batch.weight[q] * s.j[q] * trace[q];
  }
  const Lane more_pressure = tissue.kappa / batch.volume * swelling;
  Lane3 out[8] = {};
  for (int q = 0; q < 8; ++q) {
    const Curvature c(s, q, batch.weight[q], tissue, pressure);
    const auto &f = s.f[q], &g = s.inverse_t[q], &d = rate[q];
    Lane stretch = lanes::splat(0), turned[3][3], stress[3][3];  // F : grad v, grad v^T F^-T
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        stretch += f[i][j] * d[i][j];
        turned[i][j] = d[0][i] * g[0][j] + d[1][i] * g[1][j] + d[2][i] * g[2][j];
      }
    const Lane along_f = c.ff * stretch + c.fg * trace[q];
    const Lane along_g =
        c.fg * stretch + c.gg * trace[q] + batch.weight[q] * s.j[q] * more_pressure;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        stress[i][j] =
            along_f * f[i][j] + along_g * g[i][j] + c.unit * d[i][j] +
            c.swapped * (g[i][0] * turned[0][j] + g[i][1] * turned[1][j] + g[i][2] * turned[2][j]);
    for (int a = 0; a < 8; ++a) {
      const auto& by = batch.gradient[q][a];
      for (int i = 0; i < 3; ++i)
        out[a][i] += stress[i][0] * by[0] + stress[i][1] * by[1] + stress[i][2] * by[2];
    }
  }
  scatter(batch, out, product);
}

void add_batch_stiffness(const ElementBatch& batch, const BatchShape& s, const BatchTissue& tissue,
                         Lane pressure, Stiffness& k) {
  Lane block[36][9] = {};
  Lane3 dv[8] = {};  // dv/dx_a
  for (int q = 0; q < 8; ++q) {
    const Lane w = batch.weight[q];
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
    const Curvature c(s, q, w, tissue, pressure);
    for (int b = 0; b < 8; ++b) {
      Lane3 pf, pg, pt;
      for (int i = 0; i < 3; ++i) {
        pf[i] = c.ff * f[b][i] + c.fg * g[b][i];
        pg[i] = c.fg * f[b][i] + c.gg * g[b][i];
        pt[i] = c.swapped * g[b][i];
      }
      const auto& db = batch.gradient[q][b];
      for (int a = b; a < 8; ++a) {
        Lane* out = block[a * (a + 1) / 2 + b];
        const auto& da = batch.gradient[q][a];
        const Lane dot = c.unit * (da[0] * db[0] + da[1] * db[1] + da[2] * db[2]);
        for (int i = 0; i < 3; ++i) {
          for (int m = 0; m < 3; ++m)
            out[3 * i + m] += f[a][i] * pf[m] + g[a][i] * pg[m] + pt[i] * g[a][m];
          out[4 * i] += dot;
        }
      }
    }
  }
  const Lane stiff = tissue.kappa / batch.volume;
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

}  // namespace genio
