#include "speaker/outline/thin_plate.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr double same_place_of_pairs = 1e-6;  // in units of their size

double bending(double squared) { return squared > 0 ? 0.5 * squared * std::log(squared) : 0; }

}  // namespace

void ThinPlateMap::lay(const std::vector<Vec2>& from) {
  for (const Vec2& p : from) centre_ += p / double(from.size());
  double spread = 0;
  for (const Vec2& p : from) spread += (p - centre_).squaredNorm();
  size_ = std::sqrt(spread / double(from.size()));
}

ThinPlateMap::ThinPlateMap(const std::vector<PlacePair>& pairs, double smoothing) {
  std::vector<Vec2> from;
  for (const PlacePair& p : pairs) from.push_back(p.from);
  lay(from);
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

ThinPlateMap::ThinPlateMap(const std::vector<SlidingPair>& pairs, double smoothing) {
  std::vector<Vec2> from;
  for (const SlidingPair& p : pairs) from.push_back(p.from);
  lay(from);
  for (const Vec2& p : from) places_.emplace_back((p - centre_) / size_);
  const Eigen::Index n = Eigen::Index(pairs.size());
  // Unknowns: both weights of each place, then both rows of the affine part. At the minimum
  // smoothing times a weight is what its pair's metric makes of the way left.
  Matrix a = Matrix::Zero(2 * n + 6, 2 * n + 6);
  Vector b = Vector::Zero(2 * n + 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    const SlidingPair& p = pairs[size_t(i)];
    const Eigen::Matrix2d metric =
        Eigen::Matrix2d::Identity() - (1 - p.held) * p.along * p.along.transpose();
    const Vec3 place(1, places_[size_t(i)][0], places_[size_t(i)][1]);
    for (Eigen::Index k = 0; k < n; ++k)
      a.block<2, 2>(2 * i, 2 * k) =
          bending((places_[size_t(i)] - places_[size_t(k)]).squaredNorm()) * metric;
    a.block<2, 2>(2 * i, 2 * i) += smoothing * Eigen::Matrix2d::Identity();
    for (Eigen::Index k = 0; k < 3; ++k) {
      a.block<2, 2>(2 * i, 2 * n + 2 * k) = place[k] * metric;
      a.block<2, 2>(2 * n + 2 * k, 2 * i) = place[k] * Eigen::Matrix2d::Identity();
    }
    b.segment<2>(2 * i) = metric * p.to;
  }
  const Vector solution = a.partialPivLu().solve(b);
  weights_ = Eigen::Map<const Eigen::Matrix2Xd>(solution.data(), 2, n);
  affine_ = Eigen::Map<const Eigen::Matrix<double, 2, 3>>(solution.data() + 2 * n);
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
