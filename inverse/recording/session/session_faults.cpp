#include "inverse/recording/session/session_faults.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "forward/base/median.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/recording/sensor_place.hpp"
#include "inverse/recording/session/session_marks.hpp"

namespace genio {
namespace {

constexpr double on_it = 1e-3;      // of a point on the palate's trace [m]
constexpr double most_on_it = 0.8;  // share of a contour's points
// Of sensors from where they are glued, root mean square [m]: over a session, and in few frames,
// which may all be of one strong posture.
constexpr double far_places = 20e-3, far_in_few_frames = 35e-3;
constexpr double scale_slack = 0.1;  // of a scale that a palate tells
constexpr size_t many_frames = 20;   // whose usual distances are not those of one posture

Vec2 flat(const Vec3& p) { return {p[0], p[2]}; }

std::set<std::string> speakers_of(const SessionFile& session) {
  std::set<std::string> names;
  for (const ContourFrame& f : session.file.frames)
    if (!f.points.empty() && !f.speaker.empty())
      names.insert(f.speaker.substr(0, f.speaker.find(',')));
  return names;
}

/// Those that a palate leaves open.
std::pair<double, double> scales_about(const Registration& registration) {
  const double scale = registration.transform.scale;
  return {(1 - scale_slack) / scale, (1 + scale_slack) / scale};
}

/// Turned as the head is, of its own size.
ContourFile as_the_head_is(ContourFile file, const Registration& registration) {
  const Similarity& s = registration.transform;
  for (ContourFrame& frame : file.frames)
    for (ContourPoint& p : frame.points) {
      const Vec2 at = s(flat(p.position)) / s.scale;
      p.position = {at[0], p.position[1], at[1]};
    }
  return file;
}

}  // namespace

void check_same_speaker(const SessionFile& target, const SessionFile& palate) {
  const auto whose = speakers_of(target), of = speakers_of(palate);
  const auto is_theirs = [&](const std::string& name) { return whose.contains(name); };
  if (whose.empty() || of.empty() || std::ranges::any_of(of, is_theirs)) return;
  throw InputError(
      fmt::format("{}: is of speaker {}, and {} of {}: give the palate of the same head",
                  palate.path, fmt::join(of, ", "), target.path, fmt::join(whose, ", ")));
}

std::vector<Vec2> place_offsets(const Model& model, const ContourFile& file, const Similarity& s) {
  std::map<std::string, std::pair<Vec2, int>> sums;
  for (const ContourFrame& frame : file.frames)
    for (const ContourPoint& p : frame.points) {
      if (p.kind == "curve" || p.kind == "surface" || p.kind == "volume") continue;
      auto& [sum, count] = sums.try_emplace(p.kind, Vec2::Zero(), 0).first->second;
      sum += flat(p.position), ++count;
    }
  std::vector<Vec2> offsets;
  for (const auto& [place, sum] : sums)
    offsets.push_back(s(sum.first / sum.second) - flat(place_at_rest(model, place)));
  return offsets;
}

ContourFile in_other_order(const Model& model, ContourFile file) {
  std::map<double, std::string> by_arc;
  for (const auto& [kind, arc] : places_by_distance(model, file))
    by_arc[behind_tip(model, kind)] = kind;
  std::map<std::string, std::string> other;
  auto last = by_arc.rbegin();
  for (const auto& [arc, kind] : by_arc) other[kind] = (last++)->second;
  if (other.size() < 2) file.frames.clear();
  for (ContourFrame& frame : file.frames)
    for (ContourPoint& p : frame.points)
      if (const auto it = other.find(p.kind); it != other.end()) p.kind = it->second;
  return file;
}

bool is_the_palate(const ContourFile& target, const ContourFile& palate) {
  const std::vector<Vec2> trace = trace_of(palate);
  if (trace.size() < 2 || target.format.content != Content::curves) return false;
  std::vector<double> shares;
  for (const auto& contour : midsagittal_points(target)) {
    const auto on = std::count_if(contour.begin(), contour.end(), [&](const Vec2& q) {
      return foot_on(trace, q).offset.norm() < on_it;
    });
    shares.push_back(double(on) / double(contour.size()));
  }
  return median(std::move(shares)) > most_on_it;
}

std::string doubtful_places(const Model& model, const ContourFile& turned,
                            const Registration& registration, bool by_palate) {
  const bool many = turned.frames.size() >= many_frames;
  const auto scales = by_palate && many ? scales_about(registration) : any_scale;
  if (std::string said = place_contradiction(model, as_the_head_is(turned, registration), scales);
      !said.empty())
    return said;
  double square = 0, count = 0;
  for (const Vec2& o : place_offsets(model, turned, registration.transform))
    square += o.squaredNorm(), ++count;
  const double off = std::sqrt(square / std::max(1.0, count));
  const double most = many ? far_places : far_in_few_frames;
  if (off < most) return {};
  return fmt::format(
      "the sensors lie {:.0f} mm (root mean square) from where they are said to be glued, and "
      "speech moves them by less than {:.0f} mm: are they at these places?",
      1e3 * off, 1e3 * most);
}

std::string unlikely_places(const Model& model, const ContourFile& turned,
                            const Registration& registration, bool by_palate) {
  return place_contradiction(model, as_the_head_is(turned, registration),
                             by_palate ? scales_about(registration) : any_scale, usual_stretch);
}

}  // namespace genio
