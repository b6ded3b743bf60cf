#include "tests/speaker/shapes.hpp"

#include <algorithm>

namespace genio::test {
namespace {

/// Distance to a line between two points, whose thickness goes from r0 to r1 [m].
double to_limb(const Vec3& p, const Vec3& a, const Vec3& b, double r0, double r1) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - (r0 + t * (r1 - r0));
}

/// The smaller of two, rounded where they meet.
double joined(double a, double b, double round) {
  const double h = std::clamp(0.5 + 0.5 * (b - a) / round, 0.0, 1.0);
  return b + h * (a - b) - round * h * (1 - h);
}

double to_jaw(const Vec3& p) {
  const Vec3 q(p[0], std::abs(p[1]), p[2]);
  // The body: half an ellipse, taller than thick.
  double body = 1;
  constexpr int pieces = 16;
  const auto along = [](double s) {
    const double a = s * std::numbers::pi / 2;
    return Vec3(60e-3 * (1 - std::cos(a)), 42e-3 * std::sin(a), 0);
  };
  const Vec3 tall(1, 1, 0.5);
  for (int i = 0; i < pieces; ++i)
    body = std::min(body, to_limb(q.cwiseProduct(tall), along(double(i) / pieces),
                                  along(double(i + 1) / pieces), 5.5e-3, 5e-3));
  const double branch = to_limb(q, {62e-3, 42e-3, 0}, {85e-3, 46e-3, 50e-3}, 6.5e-3, 5e-3);
  const double head = to_limb(q, {85e-3, 40e-3, 52e-3}, {85e-3, 50e-3, 52e-3}, 4.5e-3, 4.5e-3);
  const double spine = to_limb(q, {4e-3, 0, -2e-3}, {8e-3, 0, -1e-3}, 2.5e-3, 1.8e-3);
  return joined(joined(joined(body, branch, 5e-3), head, 3e-3), spine, 1.5e-3);
}

}  // namespace

TriangleSurface jaw_like(double step) {
  return body({-12e-3, -62e-3, -16e-3}, {100e-3, 62e-3, 64e-3}, step, to_jaw);
}

}  // namespace genio::test
