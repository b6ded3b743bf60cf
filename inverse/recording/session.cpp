#include "inverse/recording/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "inverse/recording/session_faults.hpp"
#include "inverse/recording/session_marks.hpp"

namespace genio {
namespace {

constexpr double place_sd = 10e-3;  // of a marked point about its place at rest [m]
// Costs that differ by less do not tell two readings apart, by a palate and by contours alone.
constexpr double alike = 6, alike_alone = 12;
constexpr double far_better = 12;   // what it takes to doubt what was said
constexpr size_t least_points = 5;  // of contours that stand alone
constexpr double better_alone = 1;  // the same of a habit where contours stand alone
constexpr double oblique = 18 * std::numbers::pi / 180;  // of a bite plane that is doubted
constexpr double unusual = 15;  // cost of an articulograph whose third axis is not up

struct Candidate {
  AxesReading reading;
  Registration registration = {};
  double cost = 0;  ///< of the registration and of marked points about their places
  std::optional<double> bite_plane = {};         ///< as of AlignedRecording
  std::map<HeadPoint, double> head_points = {};  ///< the same
};

/// What a session's files hold; those beside the target may be absent.
struct Traces {
  const ContourFile *target, *palate;
  const SessionMarks* marks;
};

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

/// An articulograph that stands as most do.
bool level(const AxesReading& r) { return r.up == 2 && r.up_grows; }

/// Squared distances of marked points from where they are glued at rest, over their variance.
double place_cost(const Model& model, const ContourFile& file, const Similarity& s) {
  double cost = 0;
  for (const Vec2& off : place_offsets(model, file, s))
    cost += off.squaredNorm() / (place_sd * place_sd);
  return cost;
}

Candidate candidate(const Model& model, const TongueReach& reach, const Traces& session,
                    const AxesReading& reading) {
  const ContourFile& target = *session.target;
  const ContourFile* palate = session.palate;
  const ContourFile file = turned(target, reading);
  const auto contours = midsagittal_points(file);
  const HeadMarks marks = marks_as(model, *session.marks, reading);
  Candidate c{.reading = reading};
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

/// By how much the rest of the recording contradicts its bite plane [rad]; 0 where it does not. The
/// registration follows a bite plane, so that one without it has to tell.
double contradiction(const Model& model, const TongueReach& reach, Traces session,
                     const Candidate& best) {
  if (!best.bite_plane) return 0;
  if (std::abs(*best.bite_plane) > oblique) return *best.bite_plane;
  const SessionMarks none;
  const double plane = *best.bite_plane - best.registration.transform.angle;
  session.marks = &none;
  const Registration alone = candidate(model, reach, session, best.reading).registration;
  const double off = alone.transform.angle + plane;
  return std::abs(off) > std::hypot(oblique, 3 * alone.tilt_sd) ? off : 0;
}

std::string described(const Candidate& c, Content content) {
  return fmt::format(
      "'{}' (scale {:.2f}, tilt {:.0f} degrees, cost {:.0f}; {})", c.reading.text(content),
      c.registration.transform.scale,
      std::remainder(c.registration.transform.angle, 2 * std::numbers::pi) * 180 / std::numbers::pi,
      c.cost, c.reading.options(content));
}

/// The cheapest sound reading where the sensors are named in the other order along the tongue;
/// empty where there is none.
std::optional<Candidate> reversed_order(const Model& model, const TongueReach& reach,
                                        Traces session, const Vec3& extent,
                                        const std::function<bool(const AxesReading&)>& allowed) {
  const ContourFile other = in_other_order(model, *session.target);
  session.target = &other;
  std::optional<Candidate> best;
  if (other.frames.empty()) return best;
  for (const AxesReading& reading : all_readings(other)) {
    if (!in_plane(reading, extent) || !allowed(reading)) continue;
    Candidate c = candidate(model, reach, session, reading);
    if (best && c.cost >= best->cost) continue;
    const ContourFile seen = turned(other, reading);
    const bool by_palate = session.palate != nullptr;
    if (doubtful_places(model, seen, c.registration, by_palate).empty() &&
        judge(model, c.registration, midsagittal_points(seen), by_palate).faults.empty())
      best = std::move(c);
  }
  return best;
}

/// align() that takes all marks for true.
AlignedRecording align_by_all(const Model& model, const TongueReach& reach, SessionFile target,
                              const std::optional<SessionFile>& palate, const ReadOptions& options,
                              const SessionMarks& marks) {
  const Content content = target.file.format.content;
  const ContourFile* trace = palate ? &palate->file : nullptr;
  if (trace && trace_of(*trace).empty())
    throw InputError(palate->path + ": no palate point has a value");
  if (trace) check_same_speaker(target, *palate);
  size_t points = 0;
  for (const auto& contour : midsagittal_points(target.file)) points += contour.size();
  if (!trace && points < least_points)
    throw InputError(fmt::format(
        "{}: without a palate a recording is laid beside the model by its contours, which takes "
        "at least {} points; it has {}",
        target.path, least_points, points));
  const Traces session{&target.file, trace, &marks};
  const Vec3 extent = spread(target.file, trace);
  std::vector<Candidate> said, others;
  for (const AxesReading& reading : all_readings(target.file)) {
    const bool agreed = agrees(reading, target.axes, options, content);
    const bool asked = agreed && !options.axes.empty();
    if (!asked && !in_plane(reading, extent)) continue;
    (agreed ? said : others).push_back(candidate(model, reach, session, reading));
  }
  const auto cheaper = [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; };
  std::sort(said.begin(), said.end(), cheaper);
  std::sort(others.begin(), others.end(), cheaper);
  if (said.empty())
    throw InputError(target.path + ": no axes of its agree with what was said of them");
  const auto judged = [&](const Candidate& c) {
    return judge(model, c.registration, midsagittal_points(turned(target.file, c.reading)),
                 palate.has_value());
  };
  // The cheapest that passes the test, of those that are hardly dearer than the cheapest.
  size_t chosen = 0;
  Judgement judgement = judged(said.front());
  for (size_t k = 1; k < said.size() && !judgement.faults.empty(); ++k)
    if (said[k].cost < said.front().cost + far_better)
      if (Judgement other = judged(said[k]); other.faults.empty())
        chosen = k, judgement = std::move(other);
  const Candidate& best = said[chosen];
  const double near = palate ? alike : alike_alone;
  // Sensors may be called wrongly, and must not turn the device for it.
  const auto by_places_alone = [&](const Candidate& c) {
    return !level(best.reading) && level(c.reading) &&
           c.registration.cost < best.registration.cost + near;
  };
  for (size_t k = 0; k < said.size() && judgement.faults.empty(); ++k)
    if (k != chosen && (said[k].cost < best.cost + near || by_places_alone(said[k])) &&
        judged(said[k]).faults.empty())
      throw InputError(fmt::format(
          "{}: two readings of its axes fit alike, {} and {}; say which by those options",
          target.path, described(best, content), described(said[k], content)));
  // Which way a probe is held is a habit too, and without a palate its mirror image costs little
  // more: of 36 recordings 35 cost less the right way round, by 0.5 to 4.
  const bool said_so = !options.facing.empty() || !options.axes.empty();
  const bool mirrored = content == Content::curves && !palate && judgement.faults.empty() &&
                        !others.empty() && others.front().cost + better_alone < best.cost;
  if (mirrored && !said_so && target.file.format.facing_by_habit)
    throw InputError(fmt::format(
        "{}: its format has {}, and without a palate {} fits better; say which by those options",
        target.path, described(best, content), described(others.front(), content)));
  if (mirrored && said_so)
    target.file.remarks.push_back(fmt::format("{} fits better than what was said: is it so?",
                                              described(others.front(), content)));
  const bool as_well = content == Content::curves && !palate && judgement.faults.empty() &&
                       !others.empty() && others.front().cost < best.cost + alike_alone;
  if (as_well && !mirrored && !said_so)
    target.file.remarks.push_back(
        fmt::format("{} would fit as well, and its format has {}; say which by those options",
                    described(others.front(), content), described(best, content)));
  std::optional<Candidate> reversed;  // where the sensors may be named from the root
  if (content == Content::sensors && options.axes.empty())
    reversed = reversed_order(model, reach, session, extent, [&](const AxesReading& r) {
      return agrees(r, target.axes, options, content);
    });
  const bool on_palate = palate && is_the_palate(target.file, palate->file);
  const double bite_plane_off = contradiction(model, reach, session, best);
  AlignedRecording result{turned(std::move(target.file), best.reading),
                          best.registration,
                          best.reading,
                          judgement,
                          best.bite_plane,
                          best.head_points};
  if (const double by = bite_plane_off; std::abs(by) > 0)
    result.judgement.faults.push_back(
        fmt::format("its bite plane is tilted by {:.0f} degrees against the model's occlusal "
                    "plane, as {} place "
                    "it: is it of the same session?",
                    by * 180 / std::numbers::pi, palate ? "palate and contours" : "the contours"));
  if (!others.empty() && others.front().cost + far_better < best.cost)
    result.judgement.faults.push_back(
        fmt::format("its axes were read as {}, and {} fits better: is it a mirror image?",
                    described(best, content), described(others.front(), content)));
  if (reversed && reversed->cost + far_better < best.cost)
    result.judgement.faults.push_back(fmt::format(
        "its axes were read as {}, and with its sensors in the other order {} fits better: are "
        "they named from tip to root?",
        described(best, content), described(*reversed, content)));
  else if (reversed && reversed->cost < best.cost + near)
    result.file.remarks.push_back(fmt::format(
        "only the order of the sensors tells which way the face looks: in the other order {} would "
        "fit as well; are they named from tip to root?",
        described(*reversed, content)));
  if (content == Content::sensors) {
    const auto& r = result.registration;
    if (std::string places = doubtful_places(model, result.file, r, palate.has_value());
        !places.empty())
      result.judgement.faults.push_back(std::move(places));
    else if (places = unlikely_places(model, result.file, r, palate.has_value()); !places.empty())
      result.file.remarks.push_back("are the sensors where they are said to be? " + places);
  }
  if (on_palate)
    result.judgement.faults.emplace_back(
        "its contours lie on the palate's trace: was the palate given as the tongue?");
  result.file.facing_known = true;
  result.file.remarks.push_back(
      fmt::format("{} ({})", best.reading.text(content),
                  said.size() > 1 ? "fits best of what may be" : "as said or by its format"));
  remark_order(result.file);
  return result;
}

}  // namespace

AlignedRecording align(const Model& model, SessionFile target,
                       const std::optional<SessionFile>& palate, const ReadOptions& options,
                       const SessionMarks& marks) {
  const TongueReach reach = reach_of(model);  // takes a solve a muscle
  return by_marks_that_agree(model, marks, [&](const SessionMarks& some) {
    return align_by_all(model, reach, target, palate, options, some);
  });
}

std::string better_reading(const Model& model, const ContourFile& file, double from_rest) {
  constexpr double near_rest = 5e-3, telling = 4;  // [m], and of the cost
  if (from_rest < near_rest || file.format.content != Content::curves) return {};
  const TongueReach reach = reach_of(model);
  const auto cost = [&](const AxesReading& reading) {
    return register_by_contours(reach, midsagittal_points(turned(file, reading))).cost;
  };
  const double own = cost({});
  for (const auto& [reading, what] : {std::pair{AxesReading{0, 2, false, true}, "its mirror image"},
                                      std::pair{AxesReading{0, 2, true, false}, "upside down it"},
                                      std::pair{AxesReading{0, 2, false, false}, "turned over it"}})
    if (cost(reading) + telling < own)
      return fmt::format("{} fits far better: do x run backwards and z up, as in the model?", what);
  return {};
}

std::vector<std::vector<Vec2>> midsagittal_points(const ContourFile& file) {
  std::vector<std::vector<Vec2>> result;
  for (const auto& frame : file.frames) {
    std::vector<Vec2> line;
    for (const auto& p : frame.points)
      if (p.kind != "surface" && p.kind != "volume")
        line.emplace_back(p.position[0], p.position[2]);
    if (!line.empty()) result.push_back(std::move(line));
  }
  return result;
}

}  // namespace genio
