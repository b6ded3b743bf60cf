#include "speaker/modes/outline_modes.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "speaker/outline/rigid_frame.hpp"

namespace genio {
namespace {

constexpr int laying_passes = 5, most_modes = 20, named_shapes = 2;
constexpr double in_sight = 0.67;  // of the surface from the tip, that probes see

Vec2 place(const Vector& stacked, int i) { return stacked.segment<2>(2 * i); }
int point_of(const char* stretch, double part) {
  const OutlineStretch& s = outline_stretch(stretch);
  return s.first + int(std::lround(part * (s.count - 1)));
}
double distance_from_middle(const Vector& x) {
  const Eigen::Index n = x.size() / 2;
  const Vec2 middle = x.reshaped(2, n).rowwise().mean();
  return std::sqrt((x.reshaped(2, n).colwise() - middle).squaredNorm() / double(n));
}
double length_of(const Vector& x, const char* stretch) {
  const OutlineStretch& s = outline_stretch(stretch);
  double sum = 0;
  for (int k = 1; k < s.count; ++k)
    sum += (place(x, s.first + k) - place(x, s.first + k - 1)).norm();
  return sum;
}
/// How high the palate rises above the incisors.
double arch_height(const Vector& x) {
  const OutlineStretch& s = outline_stretch("palate");
  double most = 0;
  for (int k = 1; k < s.count; ++k)
    most = std::max(most, x[2 * (s.first + k) + 1] - x[2 * s.first + 1]);
  return most;
}
double upwards(const Vector& x, int from, int to) { return place(x, to)[1] - place(x, from)[1]; }

struct Measure {
  const char* name;
  std::function<double(const Vector&)> of;
};

/// What guides the first modes, as phoneticians measure heads.
std::vector<Measure> measures() {
  const int edge = point_of("palate", 0), arch = point_of("palate", 0.42);
  return {
      {"size", distance_from_middle},
      {"palate_height", arch_height},
      {"pharynx_length", [=](const Vector& x) { return upwards(x, point_of("hyoid", 0), arch); }},
      {"jaw_height", [=](const Vector& x) { return upwards(x, edge, point_of("mandible", 0)); }},
      {"tongue_length", [](const Vector& x) { return length_of(x, "surface"); }},
      {"pharynx_depth", [](const Vector& x) {
         return place(x, point_of("pharynx", 0.4))[0] - place(x, point_of("surface", 0.8))[0];
       }}};
}

/// What of a column no other column of an orthonormal set tells, at unit variance.
Vector standardised(Vector column, const std::vector<Vector>& before) {
  const double n = double(column.size());
  column.array() -= column.mean();
  for (const Vector& b : before) column -= b * (b.dot(column) / (n - 1));
  return column * std::sqrt((n - 1) / column.squaredNorm());
}

Vector laid(const Vector& x, const Similarity& s) {
  Vector moved = x;
  for (Eigen::Index i = 0; i < x.size() / 2; ++i)
    moved.segment<2>(2 * i) = s(Vec2(x.segment<2>(2 * i)));
  return moved;
}

std::vector<Vec2> places_of(const Vector& x) {
  std::vector<Vec2> result;
  for (int i = 0; i < int(x.size() / 2); ++i) result.push_back(place(x, i));
  return result;
}

/// The speakers as rows, laid on one another and on their mean.
Matrix laid_on_one_another(const std::vector<OutlinePoints>& speakers) {
  Matrix all(Eigen::Index(speakers.size()), 2 * outline_point_count());
  for (size_t k = 0; k < speakers.size(); ++k)
    all.row(Eigen::Index(k)) = stacked_places(speakers[k]).transpose();
  const auto seen = points_in_sight();
  Vector mean = all.row(0).transpose();
  for (int pass = 0; pass < laying_passes; ++pass) {
    for (Eigen::Index k = 0; k < all.rows(); ++k) {
      const Vector x = all.row(k).transpose();
      all.row(k) = laid(x, rigidly_laid(places_of(x), places_of(mean), seen)).transpose();
    }
    mean = all.colwise().mean().transpose();
  }
  return all;
}

/// The part of the covariance between coordinates that is sampling error: the shrinkage towards its
/// diagonal of least mean squared error.
double sampling_part(const Matrix& centred) {
  const double n = double(centred.rows());
  double error = 0, square = 0;
  for (Eigen::Index i = 0; i < centred.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const Vector w = centred.col(i).cwiseProduct(centred.col(j));
      const double mean = w.mean();
      error += n / std::pow(n - 1, 3) * (w.array() - mean).square().sum();
      square += std::pow(n / (n - 1) * mean, 2);
    }
  return std::clamp(error / square, 0.0, 1.0);
}

}  // namespace

std::vector<int> points_in_sight() {
  std::vector<int> seen;
  const OutlineStretch &palate = outline_stretch("palate"), &surface = outline_stretch("surface");
  for (int k = 0; k < palate.count; ++k) seen.push_back(palate.first + k);
  for (int k = 0; k < int(in_sight * surface.count); ++k) seen.push_back(surface.first + k);
  return seen;
}

Similarity rigidly_laid(const std::vector<Vec2>& from, const std::vector<Vec2>& to,
                        const std::vector<int>& which) {
  std::vector<Vec2> a, b;
  for (int i : which) a.push_back(from[size_t(i)]), b.push_back(to[size_t(i)]);
  return rigid_motion(a, b);
}

OutlineModes modes_of_outlines(const std::vector<OutlinePoints>& speakers) {
  constexpr size_t fewest = 8;
  if (speakers.size() < fewest) throw std::invalid_argument("modes of outlines: too few speakers");
  for (const OutlinePoints& p : speakers)
    if (std::find(p.known.begin(), p.known.end(), false) != p.known.end())
      throw std::invalid_argument("modes of outlines: a speaker lacks a point");
  const Matrix all = laid_on_one_another(speakers);
  const double n = double(all.rows());
  OutlineModes result;
  result.speakers = int(all.rows());
  result.mean = all.colwise().mean().transpose();
  const Matrix centred = all.rowwise() - result.mean.transpose();
  const double part = sampling_part(centred);
  Matrix left = centred;
  std::vector<Vector> scores, columns;
  for (const Measure& m : measures()) {
    Vector measured(all.rows());
    for (Eigen::Index k = 0; k < all.rows(); ++k) measured[k] = m.of(all.row(k).transpose());
    scores.push_back(standardised(std::move(measured), scores));
    columns.push_back(left.transpose() * scores.back() / (n - 1));
    left -= scores.back() * columns.back().transpose();
    result.names.push_back(m.name);
  }
  const Eigen::JacobiSVD<Matrix> svd(left, Eigen::ComputeThinV);
  for (int k = 0; int(columns.size()) < most_modes && k < svd.singularValues().size(); ++k) {
    if (k < named_shapes) result.names.push_back("shape" + std::to_string(k + 1));
    columns.push_back(svd.matrixV().col(k) * (svd.singularValues()[k] / std::sqrt(n - 1)));
  }
  result.modes.resize(all.cols(), Eigen::Index(columns.size()));
  for (size_t k = 0; k < columns.size(); ++k) result.modes.col(Eigen::Index(k)) = columns[k];
  const Vector variance = centred.colwise().squaredNorm().transpose() / (n - 1);
  const Vector told = (1 - part) * result.modes.rowwise().squaredNorm();
  result.kept = 1 - part;
  result.apart = (variance - told).cwiseMax(0).cwiseSqrt();
  return result;
}

}  // namespace genio
