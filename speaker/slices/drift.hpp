#pragma once
#include "speaker/slices/slice_distance.hpp"

namespace genio {

/// By slice, how far it has slid in its plane since the first [m]. From slice to slice that is the
/// way of the outlines' centroid where the slices overlap better so, and else nothing: a slanting
/// bone slides, and a branch that ends moves the centroid of what stays where it is.
std::vector<Eigen::Vector2d> slice_drift(const FlatStack& stack);

}  // namespace genio
