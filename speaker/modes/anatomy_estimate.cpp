#include "speaker/modes/anatomy_estimate.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "speaker/outline/polyline.hpp"

namespace genio {
namespace {

// What goes with no mode is alike along about a centimetre, so that nearer places tell it once.
constexpr double line_step = 10e-3;
constexpr double shortest_sight = 0.02;                            // [m]
constexpr double shift_sd = 0.05, turn_sd = std::numbers::pi / 9;  // [m], [rad]
// A palate trace goes on along the velum as a swallow raises it: anywhere within 2 cm. A contour
// that goes on past the tongue's line is within 5 mm of its end.
constexpr double beyond_palate = 0.02, beyond_tongue_sd = 5e-3;
constexpr int most_passes = 30, pose_unknowns = 3;
constexpr double settled_pass = 1e-4;  // of any unknown, in its standard deviations
constexpr std::array turns = {0.0, -0.2, 0.2, -0.4, 0.4, -0.6, 0.6};
// A trace begins anywhere behind the incisors, and along an arch it slides.
constexpr std::array slides = {0.0, -0.015, 0.015};  // [m]

Eigen::Matrix2d rotation(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }

/// A datum: a place, and the two points of the outline that it lies between.
struct Row {
  Vec2 measured, along;  ///< `along`: zero where both coordinates count
  int point, next;
  double part, noise;
};

class Estimator {
 public:
  Estimator(const OutlineModes& modes, const SpeakerSight& sight) : modes_(modes), sight_(sight) {
    for (const SightedLine& line : sight.lines) {
      if (line.points.size() < 2) continue;
      if (line.at_points) {
        for (const Vec2& p : line.points) samples_.push_back({p, line.palate, line.noise});
        continue;
      }
      const Polyline drawn(line.points);
      const int count = std::max(1, int(drawn.length() / line_step));
      for (int k = 0; k <= count; ++k)
        samples_.push_back({drawn.at(drawn.length() * k / count), line.palate, line.noise});
    }
  }

  /// From a turn of the head and a slide along it; the cost that is left.
  double run(double turn, double slide) {
    const Eigen::Index count = modes_.modes.cols();
    u_ = Vector::Zero(count + pose_unknowns);
    start_pose(turn);
    u_[count] += slide;
    for (int pass = 0; pass < most_passes; ++pass) {
      const Vector step = newton_step();
      u_ += step;
      if ((step.cwiseQuotient(prior_sd())).cwiseAbs().maxCoeff() < settled_pass) break;
    }
    newton_step();
    return cost_;
  }

  AnatomyEstimate result() const {
    const Eigen::Index count = modes_.modes.cols();
    AnatomyEstimate e;
    // Mean and covariance of the speakers are known as well as their number tells: the variance of
    // the predictive t distribution.
    const double n = std::max(5, modes_.speakers);
    const double predictive = (1 + 1 / n) * (n - 1) / (n - 3);
    const Matrix covariance =
        predictive * hessian_.llt().solve(Matrix::Identity(u_.size(), u_.size()));
    e.values = u_.head(count), e.covariance = covariance.topLeftCorner(count, count);
    e.pose.angle = u_[count + 2], e.pose.shift = u_.segment<2>(count);
    e.sd.resize(modes_.mean.size());
    for (int i = 0; i < int(modes_.mean.size() / 2); ++i) {
      e.places.push_back(placed(i));
      const Matrix j = derivative(i);
      const Eigen::Matrix2d own = predictive * own_variance(i);
      e.sd.segment<2>(2 * i) =
          ((j * covariance * j.transpose()).diagonal() + own.diagonal()).cwiseSqrt();
    }
    e.rms = rms_, e.cost = cost_;
    return e;
  }

 private:
  struct Sample {
    Vec2 place;
    bool palate;
    double noise;
  };

  Vec2 in_own_frame(int i) const {
    return modes_.mean.segment<2>(2 * i) +
           modes_.modes.middleRows<2>(2 * i) * u_.head(modes_.modes.cols());
  }
  Vec2 placed(int i) const {
    const Eigen::Index k = modes_.modes.cols();
    return rotation(u_[k + 2]) * in_own_frame(i) + Vec2(u_.segment<2>(k));
  }
  /// By all unknowns.
  Matrix derivative(int i) const {
    const Eigen::Index k = modes_.modes.cols();
    const Eigen::Matrix2d r = rotation(u_[k + 2]);
    Matrix j(2, u_.size());
    j.leftCols(k) = r * modes_.modes.middleRows<2>(2 * i);
    j.middleCols<2>(k).setIdentity();
    const Vec2 x = r * in_own_frame(i);
    j.col(k + 2) = Vec2(-x[1], x[0]);
    return j;
  }
  int known_points() const {
    return sight_.points
               ? int(std::count(sight_.points->known.begin(), sight_.points->known.end(), true))
               : 0;
  }
  /// Of what goes with no mode.
  Eigen::Matrix2d own_variance(int i) const {
    const Eigen::Matrix2d r = rotation(u_[modes_.modes.cols() + 2]);
    return r * modes_.apart.segment<2>(2 * i).cwiseAbs2().asDiagonal() * r.transpose();
  }
  Vector prior_sd() const {
    Vector sd = Vector::Constant(u_.size(), std::sqrt(std::max(modes_.kept, 1e-6)));
    sd.tail<pose_unknowns>() << shift_sd, shift_sd, turn_sd;
    return sd;
  }

  void start_pose(double turn) {
    Vec2 measured = Vec2::Zero(), ours = Vec2::Zero();
    int count = 0;
    const auto pair = [&](const Vec2& q, const Vec2& x) { measured += q, ours += x, ++count; };
    u_[modes_.modes.cols() + 2] = turn;
    if (sight_.points)
      for (size_t i = 0; i < sight_.points->places.size(); ++i)
        if (sight_.points->known[i]) pair(sight_.points->places[i], placed(int(i)));
    for (const Sample& s : samples_) {
      const OutlineStretch& stretch = outline_stretch(s.palate ? "palate" : "surface");
      pair(s.place, placed(stretch.first + stretch.count / 2));
    }
    shift0_ = (measured - ours) / std::max(1, count);
    u_.segment<2>(modes_.modes.cols()) = shift0_;
  }

  std::vector<Row> rows() const {
    std::vector<Row> result;
    if (sight_.points)
      for (size_t i = 0; i < sight_.points->places.size(); ++i)
        if (sight_.points->known[i])
          result.push_back(
              {sight_.points->places[i], Vec2::Zero(), int(i), int(i), 0, sight_.point_noise});
    for (bool palate : {true, false}) {
      const int first = outline_stretch(palate ? "palate" : "mouth_floor").first;
      const OutlineStretch& last = outline_stretch(palate ? "palate" : "surface");
      std::vector<Vec2> points;
      for (int i = first; i < last.first + last.count; ++i) points.push_back(placed(i));
      const Polyline line(points);
      for (const Sample& s : samples_) {
        if (s.palate != palate) continue;
        const auto foot = line.foot(s.place);
        const bool before = foot.s <= 0, past = foot.s >= line.length();
        if (palate && past) continue;
        if (before || past) {
          const int end = before ? first : first + int(points.size()) - 1;
          result.push_back({s.place, Vec2::Zero(), end, end, 0, beyond_tongue_sd});
          continue;
        }
        const auto above = std::upper_bound(line.arc().begin(), line.arc().end(), foot.s);
        const auto k = size_t(std::clamp<std::ptrdiff_t>(above - line.arc().begin() - 1, 0,
                                                         std::ptrdiff_t(points.size()) - 2));
        const double part = (foot.s - line.arc()[k]) / (line.arc()[k + 1] - line.arc()[k]);
        result.push_back(
            {s.place, line.tangent(foot.s), first + int(k), first + int(k) + 1, part, s.noise});
      }
    }
    return result;
  }

  /// Sets hessian, cost and rms at the present unknowns; the Gauss-Newton step from there.
  Vector newton_step() {
    const Vector weight = prior_sd().cwiseAbs2().cwiseInverse();
    Vector off = u_;
    off.segment<2>(modes_.modes.cols()) -= shift0_;
    hessian_ = weight.asDiagonal();
    Vector slope = weight.cwiseProduct(off);
    cost_ = 0.5 * off.dot(slope);
    double square = 0;
    int count = 0;
    for (const Row& row : rows()) {
      const Matrix j = (1 - row.part) * derivative(row.point) + row.part * derivative(row.next);
      const Vec2 there = (1 - row.part) * placed(row.point) + row.part * placed(row.next);
      Eigen::Matrix2d variance = own_variance(row.point);
      variance.diagonal().array() += row.noise * row.noise;
      const Vec2 r = there - row.measured;
      if (row.along.isZero(0)) {
        const Eigen::Matrix2d w = variance.inverse();
        hessian_ += j.transpose() * w * j, slope += j.transpose() * (w * r);
        cost_ += 0.5 * (r.dot(w * r) + std::log(variance.determinant()));
        square += r.squaredNorm();
      } else {
        const Vec2 across(-row.along[1], row.along[0]);
        const double v = across.dot(variance * across), d = across.dot(r);
        const Eigen::RowVectorXd a = across.transpose() * j;
        hessian_ += a.transpose() * a / v, slope += a.transpose() * (d / v);
        cost_ += 0.5 * (d * d / v + std::log(v));
        square += d * d;
      }
      ++count;
    }
    cost_ += double(int(samples_.size()) + known_points() - count) *
             std::log(beyond_palate / std::sqrt(2 * std::numbers::pi));
    rms_ = std::sqrt(square / std::max(1, count));
    return -hessian_.llt().solve(slope);
  }

  const OutlineModes& modes_;
  const SpeakerSight& sight_;
  std::vector<Sample> samples_;
  Vector u_;
  Vec2 shift0_ = Vec2::Zero();
  Matrix hessian_;
  double cost_ = 0, rms_ = 0;
};

void check_sight(const SpeakerSight& sight) {
  double length = 0;
  bool palate = false, tongue = false;
  for (const SightedLine& line : sight.lines) {
    for (size_t k = 1; k < line.points.size(); ++k)
      length += (line.points[k] - line.points[k - 1]).norm();
    (line.palate ? palate : tongue) = true;
  }
  if (!sight.points && !(palate && tongue && length >= shortest_sight))
    throw InputError(
        "a speaker's anatomy: expected a palate trace and a contour of the tongue at rest, 20 mm "
        "together or more, as one alone does not tell where the head was");
}

}  // namespace

AnatomyEstimate estimate_anatomy(const OutlineModes& modes, const SpeakerSight& sight) {
  check_sight(sight);
  Estimator estimator(modes, sight);
  double least = std::numeric_limits<double>::infinity(), best_turn = 0, best_slide = 0;
  for (double slide : slides)
    for (double turn : turns)
      if (const double cost = estimator.run(turn, slide); cost < least)
        least = cost, best_turn = turn, best_slide = slide;
  estimator.run(best_turn, best_slide);
  return estimator.result();
}

}  // namespace genio
