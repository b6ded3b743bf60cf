#include "speaker/outline/thin_plate.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr double same_place_of_pairs = 1e-6;  // in units of their size

double bending(double squared) { return squared > 0 ? 0.5 * squared * std::log(squared) : 0; }

}  // namespace

ThinPlateMap::ThinPlateMap(const std::vector<PlacePair>& pairs, double smoothing) {
  for (const PlacePair& p : pairs) centre_ += p.from / double(pairs.size());
  double spread = 0;
  for (const PlacePair& p : pairs) spread += (p.from - centre_).squaredNorm();
  size_ = std::sqrt(spread / double(pairs.size()));
  std::vector<Vec2> to;
  for (const PlacePair& p : pairs) {
    const Vec2 place = (p.from - centre_) / size_;
    if (std::none_of(places_.begin(), places_.end(),
                     [&](const Vec2& q) { return (q - place).norm() < same_place_of_pairs; }))
      places_.push_back(place), to.push_back(p.to);
  }
  const Eigen::Index n = Eigen::Index(places_.size());
  Matrix a = Matrix::Zero(n + 3, n + 3), b = Matrix::Zero(n + 3, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k)
      a(i, k) = bending((places_[size_t(i)] - places_[size_t(k)]).squaredNorm());
    a(i, i) += smoothing;
    a.row(i).tail<3>() << 1, places_[size_t(i)].transpose();
    a.col(i).tail<3>() = a.row(i).tail<3>().transpose();
    b.row(i) = to[size_t(i)].transpose();
  }
  const Matrix solution = a.partialPivLu().solve(b);
  weights_ = solution.topRows(n).transpose();
  affine_ = solution.bottomRows(3).transpose();
}

Vec2 ThinPlateMap::operator()(const Vec2& p) const {
  const Vec2 q = (p - centre_) / size_;
  Vec2 result = affine_ * Vec3(1, q[0], q[1]);
  for (size_t k = 0; k < places_.size(); ++k)
    result += bending((q - places_[k]).squaredNorm()) * weights_.col(Eigen::Index(k));
  return result;
}

Vec3 ThinPlateMap::in_space(const Vec3& p, double lateral) const {
  const Vec2 q = (*this)(Vec2(p[0], p[2]));
  return {q[0], lateral * p[1], q[1]};
}

Eigen::Matrix2d ThinPlateMap::derivative(const Vec2& p) const {
  const Vec2 q = (p - centre_) / size_;
  Eigen::Matrix2d result = affine_.rightCols<2>();
  for (size_t k = 0; k < places_.size(); ++k) {
    const Vec2 way = q - places_[k];
    const double squared = way.squaredNorm();
    if (squared > 0)
      result += weights_.col(Eigen::Index(k)) * ((1 + std::log(squared)) * way).transpose();
  }
  return result / size_;
}

double least_stretch(const ThinPlateMap& map, const std::vector<Vec2>& places) {
  double least = 1e300;
  for (const Vec2& p : places) least = std::min(least, map.derivative(p).determinant());
  return least;
}

ThinPlateMap affine_map(const std::vector<PlacePair>& pairs) { return ThinPlateMap(pairs, 1e9); }

}  // namespace genio
