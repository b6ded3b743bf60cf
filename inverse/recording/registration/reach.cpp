#include "inverse/recording/registration/reach.hpp"

#include <algorithm>
#include <limits>

#include "forward/model/at_anatomy.hpp"
#include "inverse/recording/registration/postures.hpp"

namespace genio {
namespace {

constexpr int line_points = 60;

}  // namespace

TongueReach reach_of(const Model& model, const std::function<void()>& on_step) {
  const TongueLine line(model);
  TongueReach reach{line.sample(at_anatomy(model)->rest, line_points), {}};
  reach.scale_sd = model.description->scale_sd;
  const Matrix modes = principal_modes(postures_of(model, on_step), 2, [&](const Positions& x) {
    Vector row(2 * line_points);
    const auto points = line.sample(x, line_points);
    for (int i = 0; i < line_points; ++i) row.segment<2>(2 * i) = points[size_t(i)];
    return row;
  });
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    auto& points = reach.modes.emplace_back();
    for (int i = 0; i < line_points; ++i) points.emplace_back(modes.col(k).segment<2>(2 * i));
  }
  return reach;
}

LineFoot foot_on(const std::vector<Vec2>& line, const Vec2& q) {
  double best = std::numeric_limits<double>::infinity();
  LineFoot result{0, 0, Vec2::Zero()};
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 d = line[i + 1] - line[i];
    const double t = std::clamp((q - line[i]).dot(d) / std::max(d.squaredNorm(), 1e-30), 0.0, 1.0);
    const Vec2 off = q - line[i] - t * d;
    if (off.squaredNorm() < best) best = off.squaredNorm(), result = {i, t, off};
  }
  return result;
}

}  // namespace genio
