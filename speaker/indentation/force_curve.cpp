#include "speaker/indentation/force_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/statics/sensitivity.hpp"
#include "speaker/indentation/indenter_potential.hpp"

namespace genio {
namespace {

constexpr double quarters = 4;
constexpr int most_halvings = 7;

/// An equilibrium and how it changes with the depth.
struct Place {
  double depth;
  Positions x;
  Vector along;  // dx/d(depth)
};

/// Curves over and over need few factors: far steps are halved here, not brought up from rest.
SolveOptions options() {
  SolveOptions o;
  o.tolerance = 1e-8;
  o.max_iterations = 40;
  o.max_factorizations = 60;
  o.max_load_steps = 0;
  return o;
}

/// Whether force and slope at two depths belong to one smooth curve: tissue may fold and snap.
bool joined(const ForcePoint& a, const ForcePoint& b) {
  constexpr double jump = 0.04;
  const double expected = a.force + 0.5 * (b.depth - a.depth) * (a.slope + b.slope);
  return std::abs(b.force - expected) < jump * std::max(std::abs(a.force), std::abs(b.force));
}

class CurveSolver {
 public:
  CurveSolver(const IndentationModel& m, const BlockTissue& tissue, Workspace& ws,
              ForceCurve& curve)
      : m_(m), tissue_(tissue), ws_(ws), curve_(curve) {}

  const std::string& reason() const { return reason_; }

  /// From `from` to `depth`, in halves where one step does not do. False where that fails.
  bool reach(Place& from, double depth, const Positions* start, ForcePoint& point, int halvings) {
    const Positions predicted = from.x + (depth - from.depth) * from.along;
    if (start && solve(*start, from, depth, point)) return true;
    if (solve(predicted, from, depth, point)) return true;
    if (halvings == most_halvings) return false;
    const double middle = 0.5 * (from.depth + depth);
    ForcePoint between;
    return reach(from, middle, nullptr, between, halvings + 1) &&
           reach(from, depth, nullptr, point, halvings + 1);
  }

 private:
  bool solve(const Positions& start, Place& at, double depth, ForcePoint& point) {
    const Model& model = m_.model;
    if (!std::isfinite(energy(model, start, m_.parameters(tissue_, depth)))) return false;
    const Equilibrium e =
        solve_equilibrium(model, m_.parameters(tissue_, depth), start, ws_, options());
    curve_.newton_iterations += e.newton_iterations;
    curve_.factorizations += e.factorizations;
    if (!e) return reason_ = e.message, false;
    std::array<int, 1 + block_constants> varied{m_.depth};
    for (int k = 0; k < block_constants; ++k) varied[size_t(1 + k)] = m_.first_constant + k;
    const Matrix df = force_derivatives(model, e.x, e.parameters, varied);
    const Matrix along = sensitivity_to_forces(model, e, df.leftCols(1), ws_);
    ++curve_.factorizations;
    if (along.size() == 0) return reason_ = "the block gives way: no stable shape", false;
    // With f the nodal forces and E the energy, d2E/dx dd = -df/dd, and dx/dp = K^-1 df/dp.
    const double p[2] = {depth, e.parameters[m_.depth + 1]};
    point.depth = depth;
    point.force = quarters * m_.indenter->pressing(e.x, p);
    point.slope = quarters * (m_.indenter->pressing_slope(e.x, p) - df.col(0).dot(along.col(0)));
    for (int k = 0; k < block_constants; ++k)
      point.derivative[size_t(k)] = -quarters * df.col(1 + k).dot(along.col(0));
    point.centre = model.rest[3 * m_.centre + 2] - e.x[3 * m_.centre + 2];
    point.x = e.x;
    at = {depth, e.x, along.col(0)};
    return true;
  }

  const IndentationModel& m_;
  const BlockTissue& tissue_;
  Workspace& ws_;
  ForceCurve& curve_;
  std::string reason_ = "the start shape has inverted tissue";
};

}  // namespace

ForceCurve solve_force_curve(const IndentationModel& m, const BlockTissue& tissue,
                             std::span<const double> depths, Workspace& ws,
                             const ForceCurve* near) {
  ForceCurve curve;
  const bool sharp = m.experiment.indenter != Indenter::sphere;
  CurveSolver solver(m, tissue, ws, curve);
  Place at{0, m.model.rest, Vector::Zero(m.model.rest.size())};
  for (size_t i = 0; i < depths.size(); ++i) {
    const bool known = near && i < near->points.size() && near->points[i].depth == depths[i];
    ForcePoint point;
    if (!solver.reach(at, depths[i], known ? &near->points[i].x : nullptr, point, 0)) {
      curve.message = fmt::format("no equilibrium at a depth of {:.3g} mm: {}", 1e3 * depths[i],
                                  solver.reason());
      break;
    }
    if (sharp && !curve.points.empty() && !joined(curve.points.back(), point)) {
      curve.message = fmt::format(
          "the tissue snaps to another shape between depths of {:.3g} and "
          "{:.3g} mm, where its edge folds",
          1e3 * curve.points.back().depth, 1e3 * depths[i]);
      break;
    }
    curve.points.push_back(std::move(point));
  }
  return curve;
}

}  // namespace genio
