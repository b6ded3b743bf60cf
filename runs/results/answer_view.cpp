#include "runs/results/answer_view.hpp"

#include <cmath>

#include "inverse/target/moved_target.hpp"
#include "inverse/target/tongue_line.hpp"

namespace genio {
namespace {

constexpr double near_midplane = 3e-3;  // of a surface point that is shown beside the line [m]

HeadPose pose_of(const std::vector<Estimate>& others) {
  HeadPose pose;
  for (const Estimate& e : others) {
    if (e.name == "head_pose.x") pose.shift[0] = e.best;
    if (e.name == "head_pose.z") pose.shift[1] = e.best;
    if (e.name == "head_pose.turn") pose.turn = e.best;
  }
  return pose;
}

}  // namespace

std::vector<Vec2> measured_points(const Target& target, const std::vector<Estimate>& others) {
  const Vec2 middle = target.middle();
  const MovedTarget moved(pose_of(others), middle);
  std::vector<Vec2> points;
  for (const auto& p : target.curve) points.push_back(moved(p.position));
  for (const auto& p : target.flesh) points.push_back(moved(Vec2(p.position[0], p.position[2])));
  for (const auto& p : target.surface)
    if (std::abs(p.position[1]) < near_midplane)
      points.push_back(moved(Vec2(p.position[0], p.position[2])));
  return points;
}

AnswerView view_of(const Model& model, const Target& target, const Answer& a) {
  AnswerView v;
  v.status = to_string(a.status), v.message = a.message, v.verdict = to_string(a.verdict);
  v.muscles = a.muscles, v.others = a.others, v.joint = a.joint, v.mirrored = a.mirrored,
  v.trade_offs = a.unidentified;
  for (const TradeOff& trade : a.unidentified) v.unidentified.push_back(names(trade));
  v.weight = a.weight, v.alternatives = a.alternatives, v.mixed_optima = a.mixed_optima,
  v.outliers = a.residuals.outliers;
  v.rms_mm = 1e3 * a.rms, v.max_mm = 1e3 * a.max, v.chi2_per_dof = a.chi2_per_dof;
  v.wall_s = a.wall_s, v.iterations = a.iterations, v.factorizations = a.factorizations;
  v.measured = measured_points(target, a.others);
  if (a.shape.size() > 0) v.predicted = TongueLine(model).sample(a.shape, 120);
  return v;
}

}  // namespace genio
