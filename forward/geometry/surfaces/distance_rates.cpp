#include "forward/geometry/surfaces/distance_rates.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace genio {
namespace {

constexpr double same = 1e-12;  // distances [m]

int64_t number_of(const std::array<int, 3>& node) {
  return (int64_t(node[2] + 2) << 42) + (int64_t(node[1] + 2) << 21) + node[0] + 2;
}

/// The gradient of the distance to a bone, by differences.
Vec3 slope(const BoneDistance& bone, const Vec3& at) {
  constexpr double h = 1e-7;  // [m]
  Vec3 g;
  for (int i = 0; i < 3; ++i)
    g[i] = (bone(at + h * Vec3::Unit(i)) - bone(at - h * Vec3::Unit(i))) / (2 * h);
  return g;
}

}  // namespace

const Vector& DistanceRates::sample(const Node& node) {
  const auto [it, fresh] = samples_.try_emplace(number_of(node));
  if (!fresh) return it->second;
  const Vec3 at = field_.node(node);
  const BoneDistance& bone = field_.exact();
  const auto foot = bone.face().foot(at, near_);
  const Vec3 off = at - foot.place;
  const double far = off.norm(), value = bone.from(foot, at, near_);
  Vec3 normal = foot.normal.normalized();
  if (far > same)
    normal = std::abs(std::abs(value) - far) < same ? Vec3((value > 0 ? 1 : -1) / far * off)
                                                    : slope(bone, at);
  const auto& t = surface_.triangles[size_t(near_)];
  const auto corner = [&](int k) -> const Vec3& { return surface_.vertices[size_t(t[size_t(k)])]; };
  const auto weight = closest_on_triangle(at, corner(0), corner(1), corner(2));
  Vector& rates = it->second;
  rates = Vector::Zero(Eigen::Index(fields_.size()));
  for (size_t f = 0; f < fields_.size(); ++f)
    for (size_t k = 0; k < 3; ++k)
      rates[Eigen::Index(f)] -= weight[k] * normal.dot((*fields_[f])[size_t(t[k])]);
  return rates;
}

Vector DistanceRates::coefficient(const Node& node) {
  const auto [it, fresh] = coefficients_.try_emplace(number_of(node));
  if (!fresh) return it->second;
  Vector sum = 2 * sample(node);
  for (size_t d = 0; d < 3; ++d)
    for (const int side : {-1, 1}) {
      Node beside = node;
      beside[d] += side;
      sum -= sample(beside) / 6;
    }
  return it->second = std::move(sum);
}

DistanceRates::Rates DistanceRates::at(const Vec3& p) {
  const auto count = Eigen::Index(fields_.size());
  Rates rates{Vector::Zero(count), Matrix::Zero(3, count)};
  const auto spot = field_.cell(p);
  if (!spot) return rates;
  const CubicBlend x(spot->fraction[0]), y(spot->fraction[1]), z(spot->fraction[2]);
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const Vector c =
            coefficient({spot->node[0] + i - 1, spot->node[1] + j - 1, spot->node[2] + k - 1});
        rates.value += x.n[i] * y.n[j] * z.n[k] * c;
        rates.gradient +=
            Vec3(x.d[i] * y.n[j] * z.n[k], x.n[i] * y.d[j] * z.n[k], x.n[i] * y.n[j] * z.d[k]) *
            c.transpose() / field_.fine_spacing();
      }
  return rates;
}

}  // namespace genio
