#include "inverse/recording/session/scan_session.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace genio {
namespace {

// Costs that differ by less do not tell two poses apart, by a palate and by the shape alone.
constexpr double alike_by_palate = 6, alike_by_shape = 12;
// Optima nearer to each other are one answer: what the spread of a registration tells.
constexpr double other_turn = 20 * std::numbers::pi / 180, other_way = 10e-3;

/// The rotation that a reading of right-handed axes stands for.
Mat3 rotation_of(const AxesReading& r) {
  Mat3 m = Mat3::Zero();
  m(0, r.back) = r.back_grows ? 1 : -1;
  m(2, r.up) = r.up_grows ? 1 : -1;
  m.row(1) = Vec3(m.row(2)).cross(Vec3(m.row(0)));
  return m;
}

std::vector<AxesReading> readings(const ReadOptions& options) {
  if (!options.axes.empty()) return {parse_axes(options.axes)};
  std::vector<AxesReading> all;
  for (int back = 0; back < 3; ++back)
    for (int up = 0; up < 3; ++up)
      for (const bool back_grows : {true, false})
        for (const bool up_grows : {true, false})
          if (back != up) all.push_back({back, up, back_grows, up_grows});
  return all;
}

AxesReading nearest_reading(const ScanPose& pose, const ReadOptions& options) {
  AxesReading best;
  double most = -4;
  for (const AxesReading& reading : readings(options))
    if (const double trace = (pose.turn * rotation_of(reading).transpose()).trace(); trace > most)
      most = trace, best = reading;
  return best;
}

std::string described(const ScanRegistration& r, const AxesReading& reading) {
  return fmt::format("'{}' (scale {:.2f}, cost {:.0f}; {})", reading.text(Content::sensors),
                     r.pose.scale, r.cost, reading.options(Content::sensors));
}

std::vector<Vec3> moved(const ScanPose& pose, std::vector<Vec3> points) {
  for (Vec3& p : points) p = pose(p);
  return points;
}

/// Two poses, of which nothing tells the right one.
[[noreturn]] void ask(const std::string& path, const ScanRegistration& a, const ScanRegistration& b,
                      const ReadOptions& options) {
  const AxesReading of_a = nearest_reading(a.pose, options),
                    of_b = nearest_reading(b.pose, options);
  if (of_a == of_b)
    throw InputError(fmt::format(
        "{}: the scan fits the model in two ways, both as {}; give the palate's surface in the "
        "same frame (--palate), or bring the scan into the model's frame (--registered)",
        path, described(a, of_a)));
  throw InputError(fmt::format(
      "{}: two readings of its axes fit alike, {} and {}; say which by those options, or give the "
      "palate's surface in the same frame (--palate)",
      path, described(a, of_a), described(b, of_b)));
}

/// True where nearly every point of the tongue lies on one of the palate, in the scan's own frame.
bool is_the_palate(const Scan& scan) {
  constexpr double on_it = 0.5e-3;  // [m]
  if (scan.palate.empty()) return false;
  const auto on = std::count_if(scan.tongue.begin(), scan.tongue.end(), [&](const Vec3& q) {
    return std::any_of(scan.palate.begin(), scan.palate.end(),
                       [&](const Vec3& p) { return (p - q).norm() < on_it; });
  });
  return 5 * on > 4 * std::ptrdiff_t(scan.tongue.size());
}

/// What a pose turns the axes by beside their reading.
Eigen::AngleAxisd turn_beside(const ScanPose& pose, const AxesReading& reading) {
  return Eigen::AngleAxisd(Mat3(pose.turn * rotation_of(reading).transpose()));
}

void set_turns(Judgement& j, const ScanPose& pose, const AxesReading& reading, const Vec3& middle) {
  const Eigen::AngleAxisd turn = turn_beside(pose, reading);
  const Vec3 angles = turn.angle() * turn.axis();
  j.tilt = -angles[1];
  const Vec3 shift = pose(middle) - rotation_of(reading) * middle;
  j.shift = {shift[0], shift[2]};
  j.sideways = Vec3(angles[0], angles[2], shift[1]);
}

Scan scan_of(const SessionFile& target, const std::optional<SessionFile>& palate) {
  Scan scan{surface_points(target.file), {}};
  if (scan.tongue.size() < 20)
    throw InputError(
        fmt::format("{}: a scan is laid beside the model by 20 points or more; it has "
                    "{}",
                    target.path, scan.tongue.size()));
  if (!palate) return scan;
  scan.palate = surface_points(palate->file);
  if (palate->file.format.content != Content::surface || scan.palate.size() < 20)
    throw InputError(palate->path +
                     ": expected the palate's surface (PLY, OBJ or STL, 20 points or more), in the "
                     "frame of the scan");
  return scan;
}

}  // namespace

std::vector<Vec3> surface_points(const ContourFile& file) {
  std::vector<Vec3> points;
  for (const ContourFrame& frame : file.frames)
    for (const ContourPoint& p : frame.points)
      if (p.kind == "surface" && p.position.allFinite()) points.push_back(p.position);
  return points;
}

AlignedScan align_scan(const Model& model, SessionFile target,
                       const std::optional<SessionFile>& palate, const ReadOptions& options) {
  const Scan scan = scan_of(target, palate);
  std::vector<Mat3> levels;
  for (const AxesReading& reading : readings(options)) levels.push_back(rotation_of(reading));
  const auto found = register_scan(model, surface_reach_of(model), scan, levels);
  const auto judged = [&](const ScanRegistration& r) {
    return judge_scan(model, moved(r.pose, scan.tongue), r, palate.has_value());
  };
  const ScanRegistration& best = found.front();
  Judgement judgement = judged(best);
  const double near = palate ? alike_by_palate : alike_by_shape;
  const Vec3 middle = mean(scan.tongue);
  for (size_t k = 1; k < found.size() && judgement.faults.empty(); ++k)
    if (found[k].cost < best.cost + near &&
        !near_place(best.pose, found[k].pose, middle, other_turn, other_way) &&
        judged(found[k]).faults.empty())
      ask(target.path, best, found[k], options);
  if (is_the_palate(scan))
    judgement.faults.emplace_back(
        "its points lie on the palate's surface: was the palate given as the tongue?");
  const AxesReading reading = nearest_reading(best.pose, options);
  set_turns(judgement, best.pose, reading, middle);
  const double turn = turn_beside(best.pose, reading).angle();
  if (!options.axes.empty() && turn > most_tilt)
    judgement.faults.push_back(fmt::format(
        "it is turned by {:.0f} degrees against the axes that were said, and no head is by more "
        "than {:.0f}: without --axes they are found",
        turn * 180 / std::numbers::pi, most_tilt * 180 / std::numbers::pi));
  AlignedScan result{std::move(target.file), best, reading, judgement};
  for (ContourFrame& frame : result.file.frames)
    for (ContourPoint& p : frame.points) {
      p.position = best.pose(p.position);
      p.sigma *= best.pose.scale, p.widening *= best.pose.scale;  // noise is the device's
    }
  result.file.remarks.push_back(fmt::format("{} ({}); the axes are taken as right-handed",
                                            reading.text(Content::sensors),
                                            options.axes.empty() ? "fits best" : "as said"));
  if (near_place(best.pose, {}, middle, other_turn, other_way))
    result.file.remarks.emplace_back(
        "it lies nearly in the model's frame: --registered says that it does exactly");
  return result;
}

}  // namespace genio
