#include "discrepancy/where/shape_lines.hpp"

#include "inverse/target/head_pose.hpp"
#include "inverse/target/moved_target.hpp"

namespace genio {

std::vector<ShapeLine> shape_lines(const ConditionSet& set, const JointFit& fit) {
  constexpr int count = 80;
  std::vector<ShapeLine> lines;
  for (size_t k = 0; k < fit.conditions.size(); ++k) {
    const FittedCondition& c = fit.conditions[k];
    ShapeLine line{set.members()[k], TongueLine(set.model(k)).sample(c.x, count)};
    // A fit moves data onto the model; the picture shows them where they were measured.
    const HeadPose pose = head_pose(c.unknowns, c.z), back{-pose.shift, -pose.turn};
    const Vec2 middle = set.condition(k).target.middle();
    const MovedTarget moved(back, middle);
    for (Vec2& p : line.points) p = moved(p);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace genio
