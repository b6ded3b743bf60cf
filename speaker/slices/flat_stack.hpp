#pragma once
#include <Eigen/Core>

#include "speaker/slices/contour_stack.hpp"

namespace genio {

using FlatOutline = std::vector<Eigen::Vector2d>;

/// A stack in its own frame: u and v in the slices' planes, w across them.
struct FlatStack {
  struct Slice {
    double height;                      ///< along w [m], rising from slice to slice
    std::vector<FlatOutline> outlines;  ///< [m]
    std::string name;
  };
  std::vector<Slice> slices;
  Mat3 axes;           ///< columns: u, v and w, right-handed
  std::string source;  ///< for messages

  Vec3 place(const Vec3& uvw) const { return axes * uvw; }  ///< [m]
};

/// The planes may lie anyhow. Slices whose heights fall are turned about. Throws InputError where
/// slices are not flat or not parallel, out of order or at one height, an outline has no area,
/// crosses itself or another, or the numbers can be no millimetres of a head.
FlatStack flat_stack(const ContourStack& stack);

}  // namespace genio
