#include "server/answer/request_points.hpp"

#include <fmt/format.h>

#include <cmath>

#include "inverse/recording/base/file_axes.hpp"

namespace genio {

ContourFrame points_of(const shape_request_t& r) {
  ContourFrame frame;
  frame.number = 1;
  for (int i = 0; i < r.point_count; ++i) {
    const size_t k = size_t(i);
    if (!std::isfinite(r.x_mm[k]) || !std::isfinite(r.z_mm[k]))
      throw InputError(fmt::format("point {}: x_mm and z_mm must be finite", i + 1));
    if (std::isinf(r.y_mm[k])) throw InputError(fmt::format("point {}: y_mm is infinite", i + 1));
    if (!std::isfinite(r.sigma_mm[k]) || r.sigma_mm[k] < 0)
      throw InputError(fmt::format("point {}: sigma_mm must be 0 or above", i + 1));
    if (r.kind[k] == "surface" && std::isnan(r.y_mm[k]))
      throw InputError(fmt::format("point {}: a surface point needs y_mm", i + 1));
    frame.points.push_back({1e-3 * Vec3(r.x_mm[k], r.y_mm[k], r.z_mm[k]), 1e-3 * r.sigma_mm[k],
                            r.kind[k].empty() ? "curve" : r.kind[k]});
  }
  return frame;
}

ContourFrame palate_of(const shape_request_t& r) {
  ContourFrame frame;
  frame.number = 1;
  for (int i = 0; i < r.palate_count; ++i) {
    const size_t k = size_t(i);
    ContourPoint& p = frame.points.emplace_back();
    p.position = 1e-3 * Vec3(r.palate_x_mm[k], not_given, r.palate_z_mm[k]), p.kind = "curve";
  }
  return frame;
}

double noise_of(const shape_request_t& r) {
  return r.default_sigma_mm > 0 ? 1e-3 * r.default_sigma_mm : point_noise;
}

}  // namespace genio
