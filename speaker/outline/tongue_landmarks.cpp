#include "speaker/outline/tongue_landmarks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace genio {
namespace {

constexpr double landmark_step = 2.5e-4;  // [m]
constexpr double least_notch = 0.6;       // of the line below the tip [rad]
constexpr double least_corner = 0.8;      // of a turn that is no bend [rad]
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

/// The first corner to the right between two arc lengths: where the turn is at its largest after it
/// has exceeded that of a bend, or the largest turn where none does. Behind the floor of the mouth
/// a blunt tip may turn as sharply.
double first_corner(const Polyline& line, double from, double to) {
  double best = from, most = right_turn(line, from);
  for (double s = from; s <= to; s += landmark_step) {
    const double turn = right_turn(line, s);
    if (turn > most) most = turn, best = s;
    else if (most > least_corner && s > best + corner_way) break;
  }
  return best;
}

}  // namespace

double foremost(const Polyline& line, double from, double to) {
  return where_largest(from, to, [&](double s) { return line.at(s).dot(Vec2(-1, 0.5)); });
}

double deepest_notch(const Polyline& line, double from, double to) {
  return where_largest(from, to, [&](double s) { return -right_turn(line, s); });
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
  const double above = marks.genial + 1.5 * corner_way;
  marks.floor = first_corner(line, above, tip - corner_way);
  const auto left_turn = [&](double s) { return -right_turn(line, s); };
  // Behind the floor of the mouth the line comes forward again. Where it does not, the tongue has
  // no such floor, and it leaves the mandible where it turns forward.
  const double notch = deepest_notch(line, marks.floor + 0.5 * corner_way, tip - corner_way);
  if (left_turn(notch) < least_notch) marks.floor = where_largest(above, marks.floor, left_turn);
  else marks.notch = notch;
  marks.tip = foremost(line, marks.floor + corner_way, middle);
  if (!(marks.genial < marks.floor && marks.floor < marks.tip && marks.tip < marks.vallecula))
    throw InputError(fmt::format(
        "{}: segment tongue: no floor of the mouth between mandible and tip; expected the line to "
        "run from the hyoid along the floor to the mandible, up, and over tip and dorsum",
        outline.name()));
  return marks;
}

}  // namespace genio
