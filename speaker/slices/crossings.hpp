#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace genio {

/// What is wrong with the closed outlines of a slice where one crosses or touches itself or
/// another: says which and where, in mm of the slice's plane. Empty where nothing is.
std::string crossing_fault(const std::vector<std::vector<Eigen::Vector2d>>& outlines);

}  // namespace genio
