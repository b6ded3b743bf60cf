#include "speaker/slices/drift.hpp"

#include <algorithm>

namespace genio {
namespace {

constexpr int samples = 48;       // along each axis
constexpr double clearly = 1.05;  // how much better an overlap must be

struct SliceShape {
  SliceDistance distance;
  Eigen::AlignedBox2d box;
  Eigen::Vector2d centroid;
};

SliceShape shape_of(const FlatStack::Slice& slice) {
  SliceShape shape{SliceDistance(slice.outlines), {}, Eigen::Vector2d::Zero()};
  for (const auto& outline : slice.outlines)
    for (const auto& p : outline) shape.box.extend(p);
  int inside = 0;
  const Eigen::Vector2d size = shape.box.sizes();
  for (int i = 0; i < samples; ++i)
    for (int k = 0; k < samples; ++k) {
      const Eigen::Vector2d p = shape.box.min() + size.cwiseProduct(Eigen::Vector2d(
                                                      (i + 0.5) / samples, (k + 0.5) / samples));
      if (shape.distance.inside(p)) shape.centroid += p, ++inside;
    }
  shape.centroid = inside > 0 ? Eigen::Vector2d(shape.centroid / inside) : shape.box.center();
  return shape;
}

/// What two slices have in common, over what they hold together, with b slid back by `slid`.
double overlap(const SliceShape& a, const SliceShape& b, const Eigen::Vector2d& slid) {
  Eigen::AlignedBox2d box = a.box;
  box.extend(Eigen::Vector2d(b.box.min() - slid)).extend(Eigen::Vector2d(b.box.max() - slid));
  int common = 0, either = 0;
  for (int i = 0; i < samples; ++i)
    for (int k = 0; k < samples; ++k) {
      const Eigen::Vector2d p = box.min() + box.sizes().cwiseProduct(Eigen::Vector2d(
                                                (i + 0.5) / samples, (k + 0.5) / samples));
      const bool in_a = a.distance.inside(p), in_b = b.distance.inside(p + slid);
      common += in_a && in_b, either += in_a || in_b;
    }
  return either > 0 ? double(common) / either : 0;
}

}  // namespace

std::vector<Eigen::Vector2d> slice_drift(const FlatStack& stack) {
  std::vector<Eigen::Vector2d> drift = {Eigen::Vector2d::Zero()};
  SliceShape before = shape_of(stack.slices.front());
  for (size_t s = 1; s < stack.slices.size(); ++s) {
    SliceShape shape = shape_of(stack.slices[s]);
    const Eigen::Vector2d slid = shape.centroid - before.centroid;
    const bool slides =
        overlap(before, shape, slid) > clearly * overlap(before, shape, Eigen::Vector2d::Zero());
    drift.push_back(slides ? Eigen::Vector2d(drift.back() + slid) : drift.back());
    before = std::move(shape);
  }
  return drift;
}

}  // namespace genio
