#include "forward/motion/motion_sensitivity.hpp"

#include <algorithm>
#include <cmath>

#include "forward/algebra/gmres.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/statics/sensitivity.hpp"

namespace genio {
namespace {

constexpr int most_corrections = 60;

Matrix times(const NodeMatrix& mass, const Matrix& nodal) {
  Matrix result(nodal.rows(), nodal.cols());
  for (Eigen::Index c = 0; c < nodal.cols(); ++c) result.col(c) = multiply(mass, nodal.col(c));
  return result;
}

/// Derivatives of displacement, velocity and acceleration, over all nodes.
struct State {
  Matrix u, v, a;
};

class Differentiation {
 public:
  Differentiation(const Model& model, const Controls& controls, const CommandsOverTime& commands,
                  const TimeScheme& scheme, Workspace& ws, double accuracy)
      : model_(model),
        controls_(controls),
        commands_(commands),
        s_(scheme),
        ws_(ws),
        accuracy_(accuracy),
        mass_(mass_matrix(model, commands.at(0))),
        damping_(model.pattern),
        scratch_(model.pattern) {
    for (const auto& combination : controls.combinations)
      for (const auto& share : combination) parameters_.push_back(share.parameter);
    std::sort(parameters_.begin(), parameters_.end());
    parameters_.erase(std::unique(parameters_.begin(), parameters_.end()), parameters_.end());
  }

  /// From the derivatives at one instant to those at the next. Columns beyond `active` are zero.
  bool advance(const Instant& from, const Instant& to, Eigen::Index active, State& state);

 private:
  /// dF/d unknowns of the knots that have a say at `time`.
  Matrix pulls(const Positions& x, const Vector& v, const Parameters& p, double time,
               Eigen::Index active) const;

  const Model& model_;
  const Controls& controls_;
  const CommandsOverTime& commands_;
  const TimeScheme& s_;
  Workspace& ws_;
  double accuracy_;
  NodeMatrix mass_;
  Stiffness damping_, scratch_;
  std::vector<int> parameters_;
};

Matrix Differentiation::pulls(const Positions& x, const Vector& v, const Parameters& p, double time,
                              Eigen::Index active) const {
  const Matrix each = motion_force_derivatives(model_, x, v, p, parameters_);
  const auto count = Eigen::Index(controls_.combinations.size());
  Matrix by_combination = Matrix::Zero(x.size(), count);
  for (Eigen::Index c = 0; c < count; ++c)
    for (const auto& share : controls_.combinations[size_t(c)]) {
      const auto at = std::lower_bound(parameters_.begin(), parameters_.end(), share.parameter);
      by_combination.col(c) += share.amount * each.col(at - parameters_.begin());
    }
  const Vector w = controls_.weights(time);
  Matrix result = Matrix::Zero(x.size(), active);
  for (Eigen::Index j = 0; (j + 1) * count <= active; ++j)
    if (w[j] != 0) result.middleCols(j * count, count) = w[j] * by_combination;
  return result;
}

bool Differentiation::advance(const Instant& from, const Instant& to, Eigen::Index active,
                              State& state) {
  const double dt = to.time - from.time, f = 1 - s_.alpha_f, m = 1 - s_.alpha_m;
  const double when = from.time + f * dt;
  const Parameters p = commands_.at(when);
  const Positions x = f * to.x + s_.alpha_f * from.x;
  const Vector v = f * to.velocity + s_.alpha_f * from.velocity;
  const Matrix u0 = state.u.leftCols(active), v0 = state.v.leftCols(active),
               a0 = state.a.leftCols(active);
  // At the end of the step, what does not follow the new displacement.
  const double by_u = 1 / (s_.beta * dt * dt);
  const Matrix a_known = -by_u * (u0 + dt * v0) - (0.5 / s_.beta - 1) * a0;
  const Matrix v_known = v0 + dt * ((1 - s_.gamma) * a0 + s_.gamma * a_known);

  stiffness(model_, x, p, ws_.stiffness);
  damping_.set_zero();
  add_damping(model_, x, v, p, 1, scratch_, damping_);
  Matrix known = pulls(x, v, p, when, active);
  known -= ws_.stiffness.multiply_columns(s_.alpha_f * u0);
  known -= damping_.multiply_columns(f * v_known + s_.alpha_f * v0);
  known -= times(mass_, m * a_known + s_.alpha_m * a0);
  ws_.stiffness.add(damping_, s_.gamma / (s_.beta * dt));
  ws_.stiffness.add(mass_, m * by_u / f);
  ws_.mixed.forget();  // this factor is of no static stiffness
  ws_.reduced.assign(ws_.stiffness);
  if (!ws_.cholesky.factorize(ws_.reduced)) return false;

  // The tangent lacks the slope of the viscous forces: some hundredths of it in the tissue, but
  // more than all of it where the tongue hits a bone.
  const auto solved = [&](const Matrix& nodal) {
    return Matrix(ws_.cholesky.solve(reduce_columns(model_.dofs, nodal)) / f);
  };
  const auto viscous = [&](const Matrix& along) {
    return viscous_slope(model_, x, v, p, along, scratch_);
  };
  Matrix inner = reduce_columns(model_.dofs, u0 + dt * v0);
  const auto step = [&](const Matrix& unknowns) {
    return Matrix(unknowns - solved(viscous(f * expand_columns(model_.dofs, unknowns))));
  };
  if (!gmres(step, solved(known + viscous(s_.alpha_f * u0)), accuracy_, most_corrections, inner))
    return false;
  const Matrix u = expand_columns(model_.dofs, inner);
  state.a.leftCols(active) = by_u * u + a_known;
  state.v.leftCols(active) = v0 + dt * ((1 - s_.gamma) * a0 + s_.gamma * state.a.leftCols(active));
  state.u.leftCols(active) = u;
  return true;
}

}  // namespace

Vector Controls::weights(double time) const {
  const auto n = Eigen::Index(knots.size());
  Vector w = Vector::Zero(n);
  const auto after = std::upper_bound(knots.begin(), knots.end(), time) - knots.begin();
  if (after == 0) w[0] = 1;
  else if (after == n) w[n - 1] = 1;
  else {
    const double s =
        (time - knots[size_t(after - 1)]) / (knots[size_t(after)] - knots[size_t(after - 1)]);
    w[after - 1] = 1 - s, w[after] = s;
  }
  return w;
}

CommandsOverTime Controls::over_time(const Vector& values, const Parameters& base) const {
  CommandsOverTime result;
  const auto count = Eigen::Index(combinations.size());
  for (size_t j = 0; j < knots.size(); ++j) {
    Parameters p = base;
    for (Eigen::Index c = 0; c < count; ++c)
      for (const auto& share : combinations[size_t(c)])
        p[share.parameter] = values[Eigen::Index(j) * count + c] * share.amount;
    result.times.push_back(knots[j]);
    result.values.push_back(std::move(p));
  }
  return result;
}

Positions shape_at(const Trajectory& t, double time) {
  size_t k = 1;
  while (k + 1 < t.instants.size() && t.instants[k].time < time) ++k;
  const Instant &a = t.instants[k - 1], &b = t.instants[k];
  const double s = std::clamp((time - a.time) / (b.time - a.time), 0.0, 1.0);
  return (1 - s) * a.x + s * b.x;
}

std::vector<Matrix> motion_sensitivity(const Model& given, const Controls& controls,
                                       const CommandsOverTime& commands,
                                       const Trajectory& trajectory, const TimeScheme& scheme,
                                       const Matrix& start, const std::vector<double>& when,
                                       Workspace& ws, double accuracy) {
  if (!given.filters.empty())
    throw InputError(given.name +
                     ": activation_dynamics lets forces lag behind commands; dynamic "
                     "inversion finds the forces themselves, so leave it out");
  for (const auto& combination : controls.combinations)
    for (const Controls::Share& share : combination)
      if (mode_of(given, share.parameter) >= 0)
        throw InputError(given.name + ": a mode of anatomy is no unknown of a movement");
  ws.check(given);
  const auto here = at_anatomy(given, commands.at(0));
  const Model& model = *here;
  const Eigen::Index n = model.rest.size(), count = controls.unknowns();
  State state{Matrix::Zero(n, count), Matrix::Zero(n, count), Matrix::Zero(n, count)};
  if (start.cols() > 0) state.u = start;
  Differentiation d(model, controls, commands, scheme, ws, accuracy);
  std::vector<Matrix> result(when.size(), Matrix::Zero(n, count));
  const auto& instants = trajectory.instants;
  for (size_t k = 1; k < instants.size(); ++k) {
    const double before = instants[k - 1].time, now = instants[k].time;
    for (size_t i = 0; i < when.size(); ++i)
      if (when[i] >= before && when[i] < now)
        result[i] += (now - when[i]) / (now - before) * state.u;
    // Knots from the next one on have had no say yet.
    const auto begun = std::lower_bound(controls.knots.begin(), controls.knots.end(), now - 1e-12) -
                       controls.knots.begin();
    const auto active =
        std::min(count, (Eigen::Index(begun) + 1) * Eigen::Index(controls.combinations.size()));
    if (!d.advance(instants[k - 1], instants[k], active, state)) return {};
    for (size_t i = 0; i < when.size(); ++i) {
      if (when[i] >= before && when[i] < now)
        result[i] += (when[i] - before) / (now - before) * state.u;
      if (k + 1 == instants.size() && when[i] >= now) result[i] = state.u;
    }
  }
  return result;
}

}  // namespace genio
