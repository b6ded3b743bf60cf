#pragma once
// Shapes that muscles make one by one, and the few ways to move that span them. Not for other rooms
// than the registrations.

#include <functional>
#include <vector>

#include "forward/model/model.hpp"

namespace genio {

/// Equilibria of the whole tongue.
struct Postures {
  Positions rest;                 ///< empty: the model does not rest in equilibrium
  std::vector<Positions> pulled;  ///< where one muscle each pulls with a fifth of its maximum
};

/// Takes a static solve a muscle, of half the tongue where it is its own mirror image. `on_step` as
/// of reach_of().
Postures postures_of(const Model& model, const std::function<void()>& on_step = {});

/// What is looked at of a shape: the coordinates of some points, `dimension` numbers a point.
using ShapeView = std::function<Vector(const Positions&)>;

/// The strongest principal axes, a column each, of how those postures move what is looked at, under
/// independent muscles. No posture counts as farther than 5 mm (root mean square) from rest. No
/// columns where the model does not rest in equilibrium.
Matrix principal_modes(const Postures& postures, int dimension, const ShapeView& view);

}  // namespace genio
