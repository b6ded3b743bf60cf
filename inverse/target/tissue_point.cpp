#include "inverse/target/tissue_point.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <limits>

#include "forward/geometry/hex8.hpp"

namespace genio {
namespace {

constexpr double slack = 1e-3;  // beyond an element's faces, of its half size

/// Local coordinates where the element's trilinear map gives `point` (Newton's method); what lies
/// far outside need not converge.
Vec3 local_coordinates(const HexMesh& mesh, int element, const Vec3& point) {
  const auto corner = [&](int a) -> const Vec3& {
    return mesh.nodes[size_t(mesh.elements[size_t(element)][size_t(a)])];
  };
  Vec3 xi = Vec3::Zero();
  for (int i = 0; i < 12; ++i) {
    const auto n = hex8::values(xi);
    Vec3 off = point;
    for (int a = 0; a < 8; ++a) off -= n[size_t(a)] * corner(a);
    const Vec3 step = hex8::jacobian(corner, hex8::derivatives(xi)).inverse() * off;
    xi += step.cwiseMax(-0.5).cwiseMin(0.5);
    if (step.norm() < 1e-12) break;
  }
  return xi;
}

}  // namespace

std::vector<std::pair<int, double>> tissue_point(const HexMesh& mesh, const Vec3& rest) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  Vec3 where = Vec3::Zero();
  for (int e = 0; e < int(mesh.elements.size()); ++e) {
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (int a : mesh.elements[size_t(e)])
      low = low.cwiseMin(mesh.nodes[size_t(a)]), high = high.cwiseMax(mesh.nodes[size_t(a)]);
    const Vec3 margin = 0.05 * (high - low);
    if ((rest - low + margin).minCoeff() < 0 || (high + margin - rest).minCoeff() < 0) continue;
    const Vec3 xi = local_coordinates(mesh, e, rest);
    if (const double reach = xi.cwiseAbs().maxCoeff(); reach < least)
      best = e, least = reach, where = xi;
  }
  if (!(least <= 1 + slack))
    throw InputError(
        fmt::format("the tissue point ({:.4g}, {:.4g}, {:.4g}) mm lies outside the tongue at rest",
                    1e3 * rest[0], 1e3 * rest[1], 1e3 * rest[2]));
  const auto n = hex8::values(where);
  std::vector<std::pair<int, double>> result;
  for (int a = 0; a < 8; ++a)
    result.emplace_back(mesh.elements[size_t(best)][size_t(a)], n[size_t(a)]);
  return result;
}

}  // namespace genio
