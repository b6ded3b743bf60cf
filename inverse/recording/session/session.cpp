#include "inverse/recording/session/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "inverse/recording/session/readings.hpp"
#include "inverse/recording/session/session_faults.hpp"
#include "inverse/recording/session/session_marks.hpp"

namespace genio {
namespace {

// Costs that differ by less do not tell two readings apart, by a palate and by contours alone.
constexpr double alike = 6, alike_alone = 12;
constexpr double far_better = 12;   // what it takes to doubt what was said
constexpr size_t least_points = 5;  // of contours that stand alone
constexpr double better_alone = 1;  // the same of a habit where contours stand alone

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
  const SessionTraces session{&target.file, trace, &marks};
  const auto registered_as = [&](bool said) {
    return registered_readings(model, reach, session,
                               readings_of(session, target.axes, options, said));
  };
  const std::vector<RegisteredReading> said = registered_as(true), others = registered_as(false);
  if (said.empty())
    throw InputError(target.path + ": no axes of its agree with what was said of them");
  // The cheapest that passes the test, of those that are hardly dearer than the cheapest.
  size_t chosen = 0;
  Judgement judgement = judged(model, session, said.front());
  for (size_t k = 1; k < said.size() && !judgement.faults.empty(); ++k)
    if (said[k].cost < said.front().cost + far_better)
      if (Judgement other = judged(model, session, said[k]); other.faults.empty())
        chosen = k, judgement = std::move(other);
  const RegisteredReading& best = said[chosen];
  const double near = palate ? alike : alike_alone;
  // Sensors may be called wrongly, and must not turn the device for it.
  const auto by_places_alone = [&](const RegisteredReading& c) {
    return !level(best.reading) && level(c.reading) &&
           c.registration.cost < best.registration.cost + near;
  };
  for (size_t k = 0; k < said.size() && judgement.faults.empty(); ++k)
    if (k != chosen && (said[k].cost < best.cost + near || by_places_alone(said[k])) &&
        judged(model, session, said[k]).faults.empty())
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
  std::optional<RegisteredReading> reversed;  // where the sensors may be named from the root
  if (content == Content::sensors && options.axes.empty())
    reversed = in_reversed_order(model, reach, session, target.axes, options);
  const bool on_palate = palate && is_the_palate(target.file, palate->file);
  const double bite_plane_off = contradiction(model, reach, session, best);
  AlignedRecording result{turned(std::move(target.file), best.reading),
                          best.registration,
                          best.reading,
                          judgement,
                          best.bite_plane,
                          best.head_points,
                          mirrored};
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
  return align(model, reach_of(model), std::move(target), palate, options, marks);
}

AlignedRecording align(const Model& model, const TongueReach& reach, SessionFile target,
                       const std::optional<SessionFile>& palate, const ReadOptions& options,
                       const SessionMarks& marks) {
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
