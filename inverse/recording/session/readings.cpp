#include "inverse/recording/session/readings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "inverse/recording/session/session_faults.hpp"
#include "inverse/recording/session/session_marks.hpp"

namespace genio {
namespace {

constexpr double place_sd = 10e-3;  // of a marked point about its place at rest [m]
constexpr double oblique = 18 * std::numbers::pi / 180;  // of a bite plane that is doubted
constexpr double unusual = 15;  // cost of an articulograph whose third axis is not up

/// All that a device can have. Sensors in a plane have two coordinates.
std::vector<AxesReading> all_readings(const ContourFile& file) {
  std::vector<std::pair<int, int>> pairs = {{0, 2}};
  if (file.format.content == Content::sensors)
    pairs = {{0, 2}, {2, 0}, {0, 1}, {1, 0}, {1, 2}, {2, 1}};
  std::vector<AxesReading> result;
  for (const auto& [back, up] : pairs)
    for (const bool back_grows : {true, false})
      for (const bool up_grows : {true, false}) result.push_back({back, up, back_grows, up_grows});
  return result;
}

/// The file's three coordinates spread by so much [m]: root mean squares about their means.
Vec3 spread(const ContourFile& target, const ContourFile* palate) {
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  double count = 0;
  for (const ContourFile* file : {&target, palate})
    if (file)
      for (const ContourFrame& frame : file->frames)
        for (const ContourPoint& p : frame.points)
          if (p.position.allFinite()) {
            sum += p.position, squares += p.position.cwiseAbs2();
            ++count;
          }
  if (count == 0) return Vec3::Zero();
  return (squares / count - (sum / count).cwiseAbs2()).cwiseMax(0).cwiseSqrt();
}

/// The midsagittal plane holds the two coordinates that spread most; where the third spreads nearly
/// as much as the second, either may be the one across.
bool in_plane(const AxesReading& r, const Vec3& spread) {
  const int across = 3 - r.back - r.up;
  return spread[across] <= 1.5 * std::min(spread[r.back], spread[r.up]);
}

bool agrees(const AxesReading& r, const FileAxes& format, const ReadOptions& o, Content content) {
  if (!o.axes.empty()) return r == parse_axes(o.axes);
  // What an articulograph's format says of its axes is a habit, and the device may be turned.
  const bool habit = content == Content::sensors;
  const std::string facing = !o.facing.empty() || habit ? o.facing : format.facing;
  const std::string up = !o.up.empty() || habit ? o.up : format.up;
  return (facing.empty() || r.back_grows == (facing == "left")) &&
         (up.empty() || r.up_grows == (up == "up"));
}

/// Squared distances of marked points from where they are glued at rest, over their variance.
double place_cost(const Model& model, const ContourFile& file, const Similarity& s) {
  double cost = 0;
  for (const Vec2& off : place_offsets(model, file, s))
    cost += off.squaredNorm() / (place_sd * place_sd);
  return cost;
}

RegisteredReading registered_reading(const Model& model, const TongueReach& reach,
                                     const SessionTraces& session, const AxesReading& reading) {
  const ContourFile& target = *session.target;
  const ContourFile* palate = session.palate;
  const ContourFile file = turned(target, reading);
  const auto contours = midsagittal_points(file);
  const HeadMarks marks = marks_as(model, *session.marks, reading);
  RegisteredReading c{.reading = reading};
  c.registration =
      palate ? register_by_palate(model, reach, trace_of(turned(*palate, reading)), contours, marks)
             : register_by_contours(reach, contours, marks);
  if (marks.bite_plane) c.bite_plane = c.registration.transform.angle + marks.bite_plane->tilt;
  for (const auto& [point, known] : marks.points)
    c.head_points[point] = (c.registration.transform(known.in_recording) - known.in_model).norm();
  c.cost = c.registration.cost + place_cost(model, file, c.registration.transform);
  if (target.format.content == Content::sensors && !level(reading)) c.cost += unusual;
  return c;
}

}  // namespace

bool level(const AxesReading& r) { return r.up == 2 && r.up_grows; }

std::vector<AxesReading> readings_of(const SessionTraces& session, const FileAxes& axes,
                                     const ReadOptions& options, bool said) {
  const Vec3 extent = spread(*session.target, session.palate);
  std::vector<AxesReading> result;
  for (const AxesReading& reading : all_readings(*session.target)) {
    const bool agreed = agrees(reading, axes, options, session.target->format.content);
    const bool asked = agreed && !options.axes.empty();
    if (agreed == said && (asked || in_plane(reading, extent))) result.push_back(reading);
  }
  return result;
}

std::vector<RegisteredReading> registered_readings(const Model& model, const TongueReach& reach,
                                                   const SessionTraces& session,
                                                   const std::vector<AxesReading>& readings) {
  std::vector<RegisteredReading> result;
  for (const AxesReading& reading : readings)
    result.push_back(registered_reading(model, reach, session, reading));
  std::sort(result.begin(), result.end(),
            [](const RegisteredReading& a, const RegisteredReading& b) { return a.cost < b.cost; });
  return result;
}

Judgement judged(const Model& model, const SessionTraces& session, const RegisteredReading& c) {
  return judge(model, c.registration, midsagittal_points(turned(*session.target, c.reading)),
               session.palate != nullptr);
}

double contradiction(const Model& model, const TongueReach& reach, SessionTraces session,
                     const RegisteredReading& best) {
  if (!best.bite_plane) return 0;
  if (std::abs(*best.bite_plane) > oblique) return *best.bite_plane;
  const SessionMarks none;
  const double plane = *best.bite_plane - best.registration.transform.angle;
  session.marks = &none;
  const Registration alone = registered_reading(model, reach, session, best.reading).registration;
  const double off = alone.transform.angle + plane;
  return std::abs(off) > std::hypot(oblique, 3 * alone.tilt_sd) ? off : 0;
}

std::optional<RegisteredReading> in_reversed_order(const Model& model, const TongueReach& reach,
                                                   SessionTraces session, const FileAxes& axes,
                                                   const ReadOptions& options) {
  const ContourFile other = in_other_order(model, *session.target);
  if (other.frames.empty()) return {};
  session.target = &other;
  for (RegisteredReading& c :
       registered_readings(model, reach, session, readings_of(session, axes, options, true)))
    if (doubtful_places(model, turned(other, c.reading), c.registration, session.palate != nullptr)
            .empty() &&
        judged(model, session, c).faults.empty())
      return std::move(c);
  return {};
}

std::string described(const RegisteredReading& c, Content content) {
  return fmt::format(
      "'{}' (scale {:.2f}, tilt {:.0f} degrees, cost {:.0f}; {})", c.reading.text(content),
      c.registration.transform.scale,
      std::remainder(c.registration.transform.angle, 2 * std::numbers::pi) * 180 / std::numbers::pi,
      c.cost, c.reading.options(content));
}

}  // namespace genio
