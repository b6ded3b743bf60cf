#include "forward/effects/places.hpp"

#include <algorithm>

namespace genio {
namespace {

constexpr double patch_depth = 0.010;   // [m] below the surface
constexpr double patch_radius = 0.015;  // [m]
constexpr double side = 0.6;            // of the half width
constexpr double slice = 0.006;         // how far from a cross-section nodes belong to it [m]

/// The midsagittal line from tip to root, at the fraction `s` of its length.
Vec3 on_line(const ModelDescription& d, double s) {
  const auto at = [&](size_t k) -> const Vec3& { return d.mesh.nodes[size_t(d.midsagittal[k])]; };
  size_t first = 0;
  while (first + 1 < d.midsagittal.size() && d.midsagittal[first] != d.landmarks.tip) ++first;
  double length = 0;
  for (size_t k = first + 1; k < d.midsagittal.size(); ++k) length += (at(k) - at(k - 1)).norm();
  double left = s * length;
  for (size_t k = first + 1; k < d.midsagittal.size(); ++k) {
    const double step = (at(k) - at(k - 1)).norm();
    if (left <= step) return at(k - 1) + left / step * (at(k) - at(k - 1));
    left -= step;
  }
  return at(d.midsagittal.size() - 1);
}

/// Middle of the nodes with one of these supports; false where there are none.
bool middle_of(const ModelDescription& d, std::initializer_list<Support> kinds, Vec3& middle) {
  int count = 0;
  middle.setZero();
  for (size_t a = 0; a < d.supports.size(); ++a)
    if (std::find(kinds.begin(), kinds.end(), d.supports[a]) != kinds.end())
      middle += d.mesh.nodes[a], ++count;
  if (count > 0) middle /= count;
  return count > 0;
}

/// Largest |y| near a cross-section through `at`.
double half_width(const ModelDescription& d, const Vec3& at) {
  double w = 0;
  for (const Vec3& x : d.mesh.nodes)
    if (std::abs(x[0] - at[0]) < slice && x[2] > at[2] - 2 * slice) w = std::max(w, std::abs(x[1]));
  return w;
}

Place region(const std::string& name, const Vec3& at) {
  return {name, {{"x", at[0]}, {"y", at[1]}, {"z", at[2]}, {"radius", patch_radius}}};
}

Place course(const std::string& name, const Vec3& from, const Vec3& to) {
  return {name,
          {{"from_x", from[0]},
           {"from_y", from[1]},
           {"from_z", from[2]},
           {"to_x", to[0]},
           {"to_y", to[1]},
           {"to_z", to[2]}}};
}

}  // namespace

std::vector<Place> regions(const ModelDescription& d) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : d.mesh.nodes) middle += x / double(d.mesh.nodes.size());
  const auto patch = [&](double s) {
    const Vec3 at = on_line(d, s);
    return Vec3(at + patch_depth * (middle - at).normalized());
  };
  std::vector<Place> result = {region("anterior", patch(0.2)), region("middle", patch(0.5)),
                               region("posterior", patch(0.8)), region("root", patch(1))};
  const Vec3 at = patch(0.5);
  const double y = side * half_width(d, at);
  result.push_back(region("left", at - y * Vec3::UnitY()));
  result.push_back(region("right", at + y * Vec3::UnitY()));
  return result;
}

std::vector<Place> muscle_courses(const ModelDescription& d) {
  std::vector<Place> result;
  const Vec3& dorsum = d.mesh.nodes[size_t(d.landmarks.dorsum)];
  const Vec3& root = d.mesh.nodes[size_t(d.landmarks.root)];
  Vec3 jaw, hyoid;
  const bool has_jaw = middle_of(d, {Support::fixed, Support::led}, jaw);
  if (has_jaw) {
    jaw[1] = 0;
    result.push_back(course("GGH", jaw, root));
  }
  if (middle_of(d, {Support::horizontal, Support::body, Support::forward, Support::sagittal},
                hyoid)) {
    const double w = 0.5 * half_width(d, dorsum);
    for (double s : {-1.0, 1.0}) {
      const Vec3 out = s * w * Vec3::UnitY();
      result.push_back(course(s < 0 ? "chondroglossus_L" : "chondroglossus_R",
                              Vec3(hyoid[0], 0, hyoid[2]) + 0.5 * out, dorsum + out));
    }
  }
  const auto across = [&](const char* name, const Vec3& at) {
    const Vec3 out = half_width(d, at) * Vec3::UnitY();
    result.push_back(course(name, at - out, at + out));
  };
  const Vec3 back = on_line(d, 0.65);
  const Vec3 deep = has_jaw ? jaw : Vec3(back - 0.05 * Vec3::UnitZ());
  across("palatoglossus", back + 0.006 * (deep - back).normalized());
  across("glossopharyngeus", root + 0.008 * (deep - root).normalized());
  return result;
}

Vec3 drawn_on_dorsum(const ModelDescription& d, std::mt19937& random) {
  size_t tip = 0;
  while (d.midsagittal[tip] != d.landmarks.tip) ++tip;
  const size_t last = d.midsagittal.size() - 2;
  std::uniform_int_distribution<size_t> pick(tip + 2, last);
  return d.mesh.nodes[size_t(d.midsagittal[pick(random)])];
}

}  // namespace genio
