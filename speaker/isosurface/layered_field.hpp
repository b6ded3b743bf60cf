#pragma once
#include <array>
#include <functional>
#include <span>
#include <vector>

namespace genio {

/// Values at the nodes of a grid, negative inside a body, made layer by layer so that only two
/// layers need memory.
struct LayeredField {
  std::array<std::vector<double>, 3> axis;  ///< where the nodes lie along u, v and w, rising
  /// Fills in the values of layer k of w: node (i, j) stands at j * (nodes along u) + i. Layers are
  /// asked for in order.
  std::function<void(int k, std::span<float> values)> layer;
};

}  // namespace genio
