#include "speaker/adaptation/line_pulls.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace genio {
namespace {

constexpr double pull_spacing = 1e-3, window = 8e-3, measured_spacing = 5e-4;  // [m]
constexpr double missed = 0.5e-3;  // of a notch's bottom by the line [m]

std::vector<Vec2> line_places(const ModelLine& line, const std::vector<int>& node,
                              const Positions& x) {
  std::vector<Vec2> places;
  for (size_t k = 0; k <= line.vallecula; ++k)
    places.emplace_back(x[3 * node[k]], x[3 * node[k] + 2]);
  return places;
}

/// A normal metric: across the direction `t` fully, along it in part.
Mat3 across(const Vec2& t, double weight, double along) {
  const Vec3 tangent(t[0], 0, t[1]), normal(-t[1], 0, t[0]);
  return weight * (normal * normal.transpose() + along * tangent * tangent.transpose());
}

}  // namespace

std::vector<Pull> line_pulls(const ModelLine& line, const std::vector<int>& node,
                             const Positions& x, const Polyline& outline, const LineMatch& match,
                             const LinePullOptions& o) {
  const Polyline ours(line_places(line, node, x));
  const double first = ours.arc_at(match.node.front());  // of a free surface alone nothing before
  std::vector<Pull> pulls;
  const auto add = [&](double s, const Vec2& goal, const Mat3& metric) {
    const double u = ours.position(s);
    const size_t k = std::min(size_t(u), line.vallecula - 1);
    const double part = u - double(k);
    pulls.push_back({{node[k], node[k + 1], -1, -1},
                     {1 - part, part, 0, 0},
                     Vec3(goal[0], 0, goal[1]),
                     metric});
  };
  for (size_t k = 1; k < ours.arc().size(); ++k) {
    const double gap = ours.arc()[k] - ours.arc()[k - 1];
    const int parts = std::max(2, int(std::ceil(gap / pull_spacing)));
    for (int i = 0; i < parts; ++i) {
      const double s = ours.arc()[k - 1] + gap * (i + 0.5) / parts, weight = o.weight * gap / parts;
      if (s < first) continue;
      const double there = match.to_outline(ours.position(s));
      const Polyline::Foot foot = outline.foot(ours.at(s), there - window, there + window);
      if (outline.tangent(foot.s).dot(ours.tangent(s)) > 0)
        add(s, foot.place, across(outline.tangent(foot.s), weight, o.along));
      else
        add(s, outline.at(there), across(outline.tangent(there), weight, std::max(o.along, 0.3)));
    }
  }
  const int count = std::max(1, int(outline.length() / pull_spacing));
  for (int i = 0; i < count; ++i) {
    const double s = outline.length() * (i + 0.5) / count;
    const double there = ours.arc_at(match.to_line(s));
    const Polyline::Foot foot = ours.foot(outline.at(s), there - window, there + window);
    if (foot.s <= first || outline.tangent(s).dot(ours.tangent(foot.s)) < 0) continue;
    add(foot.s, outline.at(s),
        across(outline.tangent(s), o.weight * outline.length() / count, o.along));
  }
  if (match.notch) {
    const Vec2 bottom = outline.at(match.notch->at);
    if (ours.foot(bottom).distance > missed)
      add(ours.arc_at(double(match.notch->node)), bottom, o.weight * o.notch * Mat3::Identity());
  }
  const Mat3 corner = o.weight * o.corner * Mat3::Identity();
  add(ours.length(), outline.at(outline.length()), corner);
  add(first, outline.at(0), corner);
  return pulls;
}

LineDistances line_distances(const ModelLine& line, const std::vector<int>& node,
                             const Positions& x, const Polyline& outline,
                             const TongueLandmarks& marks) {
  const Polyline ours(line_places(line, node, x));
  LineDistances d;
  std::array<double, 2> squares = {0, 0}, counts = {0, 0};  // up to the floor, and from there
  const auto measure = [&](const Polyline& from, const Polyline& to, double floor) {
    const int count = std::max(1, int(from.length() / measured_spacing));
    for (int i = 0; i < count; ++i) {
      const double s = from.length() * (i + 0.5) / count;
      const size_t part = s < floor ? 0 : 1;
      if (part == 0 && marks.floor == 0) continue;
      const double distance = to.foot(from.at(s)).distance;
      squares[part] += distance * distance, ++counts[part];
      d.most = std::max(d.most, distance);
    }
  };
  measure(ours, outline, ours.arc()[line.floor]);
  measure(outline, ours, marks.floor);
  d.floor_rms = counts[0] > 0 ? std::sqrt(squares[0] / counts[0]) : 0;
  d.free_rms = std::sqrt(squares[1] / std::max(1.0, counts[1]));
  d.rms = std::sqrt((squares[0] + squares[1]) / std::max(1.0, counts[0] + counts[1]));
  return d;
}

}  // namespace genio
