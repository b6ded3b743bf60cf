#include "speaker/outline/rigid_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "speaker/outline/polyline.hpp"

namespace genio {
namespace {

constexpr int frame_samples = 40, frame_rounds = 6;
constexpr double hard_palate = 42e-3;  // its underside, from the incisors' edge [m]

/// Samples at equal parts of a line, of its whole length or of that much of it [m].
std::vector<Vec2> equally_spaced(const std::vector<Vec2>& points,
                                 double most = std::numeric_limits<double>::infinity()) {
  const Polyline line(points);
  const double length = std::min(most, line.length());
  std::vector<Vec2> samples;
  for (int k = 0; k <= frame_samples; ++k) samples.push_back(line.at(length * k / frame_samples));
  return samples;
}

/// The model's free surface line from the tip to the root; the outline's likewise.
std::vector<Vec2> from_tip(const std::vector<Vec2>& line) {
  const auto tip = std::min_element(line.begin(), line.end(), [](const Vec2& a, const Vec2& b) {
    return a.dot(Vec2(1, -0.5)) < b.dot(Vec2(1, -0.5));
  });
  return std::vector<Vec2>(tip, line.end());
}

}  // namespace

Similarity rigid_motion(const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  Vec2 from_middle = Vec2::Zero(), to_middle = Vec2::Zero();
  for (size_t k = 0; k < from.size(); ++k) from_middle += from[k], to_middle += to[k];
  from_middle /= double(from.size()), to_middle /= double(from.size());
  double along = 0, across = 0;
  for (size_t k = 0; k < from.size(); ++k) {
    const Vec2 a = from[k] - from_middle, b = to[k] - to_middle;
    along += a.dot(b), across += a[0] * b[1] - a[1] * b[0];
  }
  Similarity s;
  s.angle = std::atan2(across, along);
  s.shift = to_middle - s(from_middle);
  return s;
}

std::vector<Vec2> underside_of_palate(const std::vector<Vec2>& given) {
  if (given.size() < 3) return {};
  std::vector<Vec2> line = given;
  double low = line[0][0], high = low;
  for (const Vec2& p : line) low = std::min(low, p[0]), high = std::max(high, p[0]);
  // The incisors' edge: the lowest place of the foremost third.
  size_t edge = 0;
  double lowest = 1e9;
  for (size_t k = 0; k < line.size(); ++k)
    if (line[k][0] < low + (high - low) / 3 && line[k][1] < lowest) lowest = line[k][1], edge = k;
  // Of the two ways from there the palate's is the one that leads farther back by its lower side.
  const auto part = [&](int step) {
    std::vector<Vec2> result;
    for (std::ptrdiff_t k = std::ptrdiff_t(edge); k >= 0 && k < std::ptrdiff_t(line.size());
         k += step)
      result.push_back(line[size_t(k)]);
    return result;
  };
  std::vector<Vec2> one = part(1), other = part(-1);
  const auto reach = [](const std::vector<Vec2>& l) {
    double most = -1e9;
    for (const Vec2& p : l) most = std::max(most, p[0]);
    return most;
  };
  std::vector<Vec2> way = reach(one) > reach(other) ? one : other;
  // As far as the velum's lower end: the lowest place behind, from where the line turns up again.
  size_t end = way.size() - 1;
  double lowest_behind = 1e9;
  for (size_t k = 0; k < way.size(); ++k)
    if (way[k][0] > 0.5 * (low + high) && way[k][1] < lowest_behind)
      lowest_behind = way[k][1], end = k;
  way.resize(end + 1);
  return way.size() < 3 ? std::vector<Vec2>{} : way;
}

std::vector<Vec2> front_of_palate(const std::vector<Vec2>& given) {
  std::vector<Vec2> way = underside_of_palate(given);
  // Up to the top of the arch, before the line first falls by 2 mm.
  size_t top = 0;
  for (size_t k = 0; k < way.size() && way[k][1] > way[top][1] - 2e-3; ++k)
    if (way[k][1] > way[top][1]) top = k;
  way.resize(way.empty() ? 0 : top + 1);
  return way.size() < 3 ? std::vector<Vec2>{} : way;
}

namespace {

/// One step there: what counts as the palate's front depends a little on how the outline is tilted.
Similarity nearer_frame(const SpeakerOutline& outline, const ModelDescription& model) {
  if (outline.has(Segment::palate) && model.palate) {
    const std::vector<Vec2> theirs = underside_of_palate(outline.segments.at(Segment::palate));
    const auto cuts = midsagittal_cut(*model.palate);
    const std::vector<Vec2> ours =
        cuts.empty() ? std::vector<Vec2>{} : underside_of_palate(cuts.front());
    // Not up to the top of the arch: where a flat arch has its top is chance.
    if (!theirs.empty() && !ours.empty())
      return rigid_motion(equally_spaced(theirs, hard_palate), equally_spaced(ours, hard_palate));
  }
  std::vector<Vec2> ours;
  for (int a : model.midsagittal)
    ours.emplace_back(model.mesh.nodes[size_t(a)][0], model.mesh.nodes[size_t(a)][2]);
  return rigid_motion(equally_spaced(from_tip(outline.tongue())), equally_spaced(from_tip(ours)));
}

}  // namespace

Similarity rigid_frame(const SpeakerOutline& outline, const ModelDescription& model) {
  Similarity whole;
  for (int round = 0; round < frame_rounds; ++round) {
    const Similarity more = nearer_frame(moved_outline(outline, whole), model);
    whole.shift = more(whole.shift);
    whole.angle += more.angle;
  }
  return whole;
}

SpeakerOutline moved_outline(SpeakerOutline outline, const Similarity& to_model) {
  for (auto& [segment, points] : outline.segments)
    for (Vec2& p : points) p = to_model(p);
  return outline;
}

}  // namespace genio
