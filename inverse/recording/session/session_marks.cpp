#include "inverse/recording/session/session_marks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/registration/head_places.hpp"

namespace genio {
namespace {

constexpr double doubted = 3;  // standard deviations

/// All sightings of a point, (back, up) [m].
std::vector<Vec2> sightings(const SessionPoint& point, const AxesReading& reading) {
  std::vector<Vec2> all;
  for (const auto& line : midsagittal_points(turned(point.file.file, reading)))
    all.insert(all.end(), line.begin(), line.end());
  return all;
}

/// How well a point of the session tells where the model's lies [m]: it moves, too.
double sd_in(HeadPoint point, const SessionPoint& seen) {
  return std::hypot(sd_of(point), middle_of(sightings(seen, {})).spread);
}

bool is_far(const AlignedRecording& a, HeadPoint point, const SessionPoint& seen) {
  const auto off = a.head_points.find(point);
  return off != a.head_points.end() && off->second > doubted * sd_in(point, seen);
}

/// The named point that is off by most of its standard deviations; end() where none is doubted.
SessionPoints::const_iterator farthest(const AlignedRecording& a, const SessionPoints& points) {
  auto result = points.end();
  double most = 0;
  for (auto it = points.begin(); it != points.end(); ++it) {
    if (!it->second.by_name || !is_far(a, it->first, it->second)) continue;
    const double off = a.head_points.at(it->first) / sd_in(it->first, it->second);
    if (off > most) most = off, result = it;
  }
  return result;
}

std::string fault_of(const std::vector<std::string>& far) {
  return fmt::format(
      "what it shows of the head lies far from the model's, once it is registered: {}; is that in "
      "the numbers of the contours, and are units and axes as said?",
      fmt::join(far, ", "));
}

std::string far_text(HeadPoint point, double off) {
  return fmt::format("{} {:.0f} mm", name_of(point), 1e3 * off);
}

/// Without the named points that the model lacks, of which `remarks` tell.
SessionPoints those_of(const Model& model, SessionPoints points,
                       std::vector<std::string>& remarks) {
  std::erase_if(points, [&](const auto& entry) {
    const auto& [point, seen] = entry;
    if (!seen.by_name || place_in(model, point)) return false;
    remarks.push_back(fmt::format("its {} is left out: {}", name_of(point), lack_of(point)));
    return true;
  });
  return points;
}

/// What tells of the named points that were used.
std::string remark_of(const SessionPoints& points) {
  std::vector<std::string> used;
  for (const auto& [point, seen] : points)
    if (seen.by_name)
      used.push_back(fmt::format("{} (in {} frames, within {:.0f} mm)", name_of(point),
                                 seen.file.file.frames.size(), 1e3 * sd_in(point, seen)));
  if (used.empty()) return {};
  return fmt::format(
      "registered by points of the head, too, that it has by name: {} "
      "(--ignore-marks leaves them out)",
      fmt::join(used, ", "));
}

/// The point at `place`, in the numbers of the target's contours.
SessionFile in_numbers_of(const SessionFile& target, const std::vector<Vec2>& places,
                          const std::string& name, const ReadOptions& options) {
  ContourFile file;
  file.format = target.file.format;
  for (const Vec2& place : places) {
    ContourPoint& point = file.frames.emplace_back().points.emplace_back();
    point.position = {place[0], not_given, place[1]}, point.kind = "head";
  }
  ReadOptions same_units = options;
  same_units.units = target.file.units;
  return {name, in_metres(std::move(file), target.axes, name, same_units), target.axes};
}

SessionFile point_at(HeadPoint point, const std::string& text, const SessionFile& target,
                     const ReadOptions& options) {
  const auto comma = text.find(',');
  double x = 0, y = 0;
  if (comma == std::string::npos || !parse_number(text.substr(0, comma), x) ||
      !parse_number(text.substr(comma + 1), y))
    throw InputError(fmt::format("{} {}: expected X,Y, two numbers as the contours have",
                                 option_of(point), text));
  if (target.file.format.content != Content::curves)
    throw InputError(
        fmt::format("{}: does not apply; {} holds no curves", option_of(point), target.path));
  return in_numbers_of(target, {Vec2(x, y)}, fmt::format("{} {}", option_of(point), text), options);
}

/// Contours alone follow a point that is far off. Where a recording fails by what it names, and
/// would pass without, a single point is left out and several are blamed.
void heed_contradiction(AlignedRecording& a, SessionMarks& marks, std::vector<std::string>& remarks,
                        const std::function<AlignedRecording(const SessionMarks&)>& align) {
  SessionMarks given = marks;
  std::vector<std::string> named;
  std::erase_if(given.points, [&](const auto& entry) {
    if (entry.second.by_name) named.emplace_back(name_of(entry.first));
    return entry.second.by_name;
  });
  if (named.empty() || a.judgement.faults.empty()) return;
  AlignedRecording without = align(given);
  if (!without.judgement.faults.empty()) return;
  if (named.size() == 1) {
    remarks.push_back(
        fmt::format("its {} is left out: it contradicts the contours", named.front()));
    a = std::move(without), marks = std::move(given);
  } else {
    a.judgement.faults.push_back(
        fmt::format("what it shows of the head contradicts the contours: {} (--ignore-marks leaves "
                    "that out)",
                    fmt::join(named, ", ")));
  }
}

}  // namespace

std::vector<Vec2> trace_of(const ContourFile& palate) {
  std::vector<Vec2> trace;
  for (const auto& line : midsagittal_points(palate)) {
    trace.insert(trace.end(), line.begin(), line.end());
    if (palate.format.content != Content::sensors) break;
  }
  return trace;
}

const char* option_of(HeadPoint point) {
  switch (point) {
    case HeadPoint::hyoid:
      return "--hyoid";
    case HeadPoint::short_tendon:
      return "--short-tendon";
    case HeadPoint::mandible:
      return "--jaw-shadow";
  }
  return "";
}

SessionPoints head_points_of(const SessionFile& target,
                             const std::map<HeadPoint, std::string>& given, bool named,
                             const ReadOptions& options) {
  SessionPoints points;
  for (const auto& [point, text] : given)
    if (!text.empty()) points[point] = {point_at(point, text, target, options), false};
  if (named)
    for (const auto& [point, places] : target.file.head_points)
      if (!points.contains(point))
        points[point] = {in_numbers_of(target, places, target.path, options), true};
  return points;
}

HeadMarks marks_as(const Model& model, const SessionMarks& session, const AxesReading& reading) {
  HeadMarks marks;
  if (session.bite_plane)
    marks.bite_plane = bite_plane_of(trace_of(turned(session.bite_plane->file, reading)),
                                     session.bite_plane->path);
  // Both of the jaw's are off alike where it opens or is another's: together they are one.
  const bool both = session.points.contains(HeadPoint::short_tendon) &&
                    session.points.contains(HeadPoint::mandible);
  for (const auto& [point, seen] : session.points) {
    const auto place = place_in(model, point);
    if (!place) throw InputError(fmt::format("{}: {}", option_of(point), lack_of(point)));
    const double alike = both && point != HeadPoint::hyoid ? std::sqrt(2) : 1;
    marks.points[point] = {middle_of(sightings(seen, reading)).point, *place,
                           alike * sd_in(point, seen)};
  }
  return marks;
}

AlignedRecording by_marks_that_agree(
    const Model& model, SessionMarks marks,
    const std::function<AlignedRecording(const SessionMarks&)>& align) {
  std::vector<std::string> remarks, dropped;
  marks.points = those_of(model, std::move(marks.points), remarks);
  const SessionPoints all = marks.points;
  AlignedRecording a = align(marks);
  for (auto far = farthest(a, marks.points); far != marks.points.end();
       far = farthest(a, marks.points)) {
    dropped.push_back(far_text(far->first, a.head_points.at(far->first)));
    marks.points.erase(far);
    a = align(marks);
  }
  std::vector<std::string> faults;
  for (const auto& [point, seen] : marks.points)
    if (is_far(a, point, seen)) faults.push_back(far_text(point, a.head_points.at(point)));
  if (dropped.size() > 1 && dropped.size() + faults.size() == all.size())
    faults.insert(faults.end(), dropped.begin(), dropped.end());
  else
    for (const std::string& far : dropped)
      remarks.push_back(
          fmt::format("left out as it lies far from the model's, once it is registered: {}", far));
  if (!faults.empty()) a.judgement.faults.push_back(fault_of(faults));
  else heed_contradiction(a, marks, remarks, align);
  if (const std::string used = remark_of(marks.points); !used.empty()) remarks.push_back(used);
  a.file.remarks.insert(a.file.remarks.end(), remarks.begin(), remarks.end());
  return a;
}

}  // namespace genio
