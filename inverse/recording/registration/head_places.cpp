#include "inverse/recording/registration/head_places.hpp"

#include <algorithm>
#include <cmath>

#include "forward/base/median.hpp"
#include "forward/model/at_anatomy.hpp"

namespace genio {
namespace {

/// Points of the midsagittal cut; none where the model has no such surface, or one that lies aside.
std::vector<Vec2> cut_of(const std::optional<TriangleSurface>& surface) {
  std::vector<Vec2> points;
  if (surface)
    for (const auto& line : midsagittal_cut(*surface))
      points.insert(points.end(), line.begin(), line.end());
  return points;
}

std::optional<Vec2> hyoid_of(const Model& model) {
  const auto cut = cut_of(at_anatomy(model)->hyoid);
  if (cut.empty()) return {};
  Vec2 middle = Vec2::Zero();
  for (const Vec2& q : cut) middle += q / double(cut.size());
  return middle;
}

std::optional<Vec2> short_tendon_of(const Model& model) {
  std::optional<Vec2> lowest;
  for (const Muscle& muscle : model.muscles) {
    if (!muscle.name.starts_with("GG")) continue;
    for (const Fibre& fibre : muscle.fibres)
      for (const FibrePoint& end : {fibre.front(), fibre.back()}) {
        if (end.node < 0) continue;
        const Support support = model.supports[size_t(end.node)];
        if (support != Support::fixed && support != Support::led) continue;
        const auto at = node_position(at_anatomy(model)->rest, end.node);
        if (!lowest || at[2] < (*lowest)[1]) lowest = Vec2(at[0], at[2]);
      }
  }
  return lowest;
}

std::optional<Vec2> shadow_of(const Model& model) {
  const auto cut = cut_of(at_anatomy(model)->jaw);
  if (cut.empty()) return {};
  return *std::max_element(cut.begin(), cut.end(),
                           [](const Vec2& a, const Vec2& b) { return a[0] - a[1] < b[0] - b[1]; });
}

}  // namespace

double sd_of(HeadPoint point) {
  switch (point) {
    case HeadPoint::hyoid:
      return 9e-3;
    case HeadPoint::short_tendon:
      return 7e-3;
    case HeadPoint::mandible:
      return 8e-3;
  }
  return 0;
}

std::optional<Vec2> place_in(const Model& model, HeadPoint point) {
  switch (point) {
    case HeadPoint::hyoid:
      return hyoid_of(model);
    case HeadPoint::short_tendon:
      return short_tendon_of(model);
    case HeadPoint::mandible:
      return shadow_of(model);
  }
  return {};
}

std::string lack_of(HeadPoint point) {
  switch (point) {
    case HeadPoint::hyoid:
      return "the model file has no hyoid in [surfaces] across the midplane";
    case HeadPoint::short_tendon:
      return "the model has no genioglossus that starts at the jaw";
    case HeadPoint::mandible:
      return "the model file has no jaw in [surfaces] across the midplane";
  }
  return "";
}

Middle middle_of(const std::vector<Vec2>& points) {
  constexpr double to_sd = 1.4826;  // of the median deviation of a Gaussian
  std::vector<double> x, y;
  for (const Vec2& p : points) x.push_back(p[0]), y.push_back(p[1]);
  Middle m{{median(x), median(y)}};
  if (points.size() < 3) return m;
  for (double& v : x) v = std::abs(v - m.point[0]);
  for (double& v : y) v = std::abs(v - m.point[1]);
  m.spread = to_sd * std::hypot(median(x), median(y)) / std::sqrt(2);
  return m;
}

}  // namespace genio
