#include "inverse/recording/frame_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/effects/surroundings/contact.hpp"
#include "forward/model/at_anatomy.hpp"
#include "inverse/recording/base/file_axes.hpp"
#include "inverse/recording/contour_file.hpp"
#include "inverse/recording/sensor_place.hpp"
#include "inverse/target/tissue_point.hpp"

namespace genio {
namespace {

constexpr double too_far = 0.12;  // [m] from the middle of the tongue

bool inside_bone(const Model& model, const Vec3& p) {
  const auto here = at_anatomy(model);
  for (const auto& contact : here->contacts)
    if (contact->distance(Vec3(p[0], 0, p[2])) < 0) return true;
  return false;
}

std::vector<std::pair<int, double>> flesh(const Model& model, const ContourPoint& p) {
  if (p.kind == "volume") return tissue_point(at_anatomy(model)->mesh, p.rest);
  return sensor_place(model, p.kind);
}

}  // namespace

ContourFrame registered(const Model& model, const ContourFrame& frame,
                        const Similarity& transform) {
  ContourFrame result = frame;
  result.registered = true;
  auto& points = result.points;
  for (ContourPoint& p : points) {
    const Vec2 moved = transform(Vec2(p.position[0], p.position[2]));
    p.position[0] = moved[0], p.position[2] = moved[1];
    p.sigma *= transform.scale, p.widening *= transform.scale;  // noise is the device's
  }
  if (std::any_of(points.begin(), points.end(),
                  [](const ContourPoint& p) { return p.kind != "curve"; }))
    return result;
  // The innermost bad point of each outer third decides: what lies beyond it is no better.
  const size_t size = points.size();
  size_t first = 0, last = size;
  for (size_t i = 0; i < size / 3; ++i) {
    if (inside_bone(model, points[i].position)) first = i + 1;
    if (inside_bone(model, points[size - 1 - i].position)) last = size - 1 - i;
  }
  points = std::vector<ContourPoint>(points.begin() + long(first), points.begin() + long(last));
  if (points.size() < size)
    result.add_note(fmt::format("{} end points inside bone left out", size - points.size()));
  return result;
}

Target make_target(const Model& model, const ContourFrame& frame, double noise) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : model.mesh.nodes) middle += x / double(model.mesh.nodes.size());
  const double longer = frame.registered ? longer_line : 0;
  Target target;
  for (size_t i = 0; i < frame.points.size(); ++i) {
    const ContourPoint& p = frame.points[i];
    const Vec3& q = p.position;
    const double sigma = p.sigma > 0 ? p.sigma : p.widening * noise;
    const Vec3 flat(q[0], std::isnan(q[1]) ? 0.0 : q[1], q[2]);
    if (!((flat - middle).norm() < too_far))
      throw InputError(fmt::format(
          "frame {}, point {}: ({:.4g}, {:.4g}) mm lies {:.4g} mm from the middle of the tongue; "
          "expected millimetres in the model's frame. Wrong units, or not registered?",
          frame.number, i + 1, 1e3 * q[0], 1e3 * q[2], 1e3 * (flat - middle).norm()));
    if (p.kind == "curve") target.curve.push_back({Vec2(q[0], q[2]), sigma, longer});
    else if (p.kind == "surface") target.surface.push_back({q, sigma, p.slice});
    else target.flesh.push_back({flesh(model, p), q, sigma, p.kind});
  }
  if (frame.points.size() > 2) {
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (const auto& p : frame.points) {
      const Vec3 flat(p.position[0], 0, p.position[2]);
      low = low.cwiseMin(flat), high = high.cwiseMax(flat);
    }
    if ((high - low).norm() < 1e-3)
      throw InputError(fmt::format(
          "frame {}: all points lie within {:.3g} mm; a tongue contour has 20 to 150 mm. Wrong "
          "units? Expected millimetres",
          frame.number, 1e3 * (high - low).norm()));
  }
  return target;
}

std::vector<std::pair<int, double>> place_weights(const Model& model, const std::string& place) {
  ContourPoint p;
  p.kind = place;
  return flesh(model, p);
}

Vec3 place_at_rest(const Model& model, const std::string& place) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [node, weight] : place_weights(model, place))
    sum += weight * model.mesh.nodes[size_t(node)];
  return sum;
}

}  // namespace genio
