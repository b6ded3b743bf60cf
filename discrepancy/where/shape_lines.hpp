#pragma once
// Midsagittal lines of fitted shapes, for pictures.

#include "discrepancy/conditions/joint_fit.hpp"

namespace genio {

struct ShapeLine {
  size_t condition;          ///< index into the observations
  std::vector<Vec2> points;  ///< where the data lie, (x, z) [m]
};

/// One line a condition of the fit.
std::vector<ShapeLine> shape_lines(const ConditionSet& set, const JointFit& fit);

}  // namespace genio
