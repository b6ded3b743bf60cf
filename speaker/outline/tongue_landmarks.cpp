#include "speaker/outline/tongue_landmarks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace genio {
namespace {

constexpr double landmark_step = 2.5e-4;  // [m]
constexpr double corner_way = 4e-3;       // on both sides of a corner [m]

/// Where a measure is largest between two arc lengths.
double where_largest(double from, double to, const std::function<double(double)>& measure) {
  double best = from, most = measure(from);
  for (double s = from; s <= to; s += landmark_step)
    if (const double m = measure(s); m > most) most = m, best = s;
  return best;
}

/// How far the line turns to the right about a place [rad].
double right_turn(const Polyline& line, double s) {
  const Vec2 in = line.at(s) - line.at(s - corner_way), out = line.at(s + corner_way) - line.at(s);
  return std::atan2(in[1] * out[0] - in[0] * out[1], in.dot(out));
}

}  // namespace

double foremost(const Polyline& line, double from, double to) {
  return where_largest(from, to, [&](double s) { return line.at(s).dot(Vec2(-1, 0.5)); });
}

TongueLandmarks tongue_landmarks(const SpeakerOutline& outline) {
  const Polyline line(outline.tongue());
  TongueLandmarks marks;
  marks.vallecula = line.length();
  if (outline.free_surface_only) {
    marks.tip = foremost(line, 0, 0.5 * line.length());
    return marks;
  }
  // The floor ends at the foremost of what lies low. Above it the line turns back sharply where it
  // leaves the mandible for the floor of the mouth.
  marks.genial =
      where_largest(0, 0.5 * line.length(), [&](double s) { return line.at(s).dot(Vec2(-1, -1)); });
  const double middle = 0.75 * line.length();
  const double tip = foremost(line, marks.genial + 2 * corner_way, middle);
  marks.floor = where_largest(marks.genial + 1.5 * corner_way, tip - corner_way,
                              [&](double s) { return right_turn(line, s); });
  marks.tip = foremost(line, marks.floor + corner_way, middle);
  if (!(marks.genial < marks.floor && marks.floor < marks.tip && marks.tip < marks.vallecula))
    throw InputError(fmt::format(
        "{}: segment tongue: no floor of the mouth between mandible and tip; expected the line to "
        "run from the hyoid along the floor to the mandible, up, and over tip and dorsum",
        outline.name()));
  return marks;
}

}  // namespace genio
