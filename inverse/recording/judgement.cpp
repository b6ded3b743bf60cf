#include "inverse/recording/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "forward/base/median.hpp"
#include "forward/effects/surroundings/contact.hpp"
#include "forward/model/at_anatomy.hpp"

namespace genio {
namespace {

constexpr double shortest_line = 0.12, longest_line = 0.16;  // of 41 speakers' tongues [m]
constexpr double slack = 1.15;
constexpr double far_size = 6;          // standard deviations of a size that is still believed
constexpr double telling = 8;           // fall of the cost, in squares of standard deviations
constexpr double poor_palate = 3e-3;    // [m]
constexpr double out_of_reach = 15e-3;  // root mean square from the line at rest [m]
constexpr double into_bone = 3e-3;      // what noise and another anatomy explain [m]
constexpr double most_behind = 0.2;     // share of points
constexpr double unlike = 3e-3;         // root mean square of a scan from what muscles make [m]

/// The share of points in the model's frame that lie deeper in a bone than that [m].
double behind(const Model& model, const std::vector<Vec3>& points, double depth) {
  const auto here = at_anatomy(model);
  const auto beyond = std::count_if(points.begin(), points.end(), [&](const Vec3& p) {
    return std::any_of(here->contacts.begin(), here->contacts.end(),
                       [&](const auto& c) { return c->distance(p) < -depth; });
  });
  return points.empty() ? 0 : double(beyond) / double(points.size());
}

/// Faults that a size, a palate, a place and what lies in bone make, whatever was registered.
void add_common_faults(const Model& model, Judgement& j, double free_scale, double free_gain,
                       bool has_palate, const char* what) {
  const auto [least, most] = plausible_scales(model);
  const auto nobodys = [&, least = least, most = most](double scale) {
    return !(scale >= least && scale <= most);
  };
  // What is believed of the scale holds it near 1; the recording itself may know better.
  const bool knows = free_gain > telling;
  if (nobodys(j.scale) || (knows && nobodys(free_scale)))
    j.faults.push_back(fmt::format(
        "its scale is {:.2f}, where speakers have {:.2f} to {:.2f}: are the units as said, and is "
        "the palate of the same session?",
        knows ? free_scale : j.scale, least, most));
  if (has_palate && j.palate_rms > poor_palate)
    j.faults.push_back(
        fmt::format("the palate lies {:.1f} mm (root mean square) from the model's palate, "
                    "and at most {:.0f} mm will do: is it the hard palate, of the same session?",
                    1e3 * j.palate_rms, 1e3 * poor_palate));
  if (j.behind_palate > most_behind)
    j.faults.push_back(fmt::format(
        "{:.0f} % of the points of the {} lie behind palate or jaw: are they the tongue's, "
        "and the palate the same speaker's?",
        100 * j.behind_palate, what));
  if (j.from_rest > out_of_reach)
    j.faults.push_back(fmt::format(
        "the points of the {} lie {:.0f} mm from the tongue at rest, and no tongue moves as a "
        "whole by more than {:.0f} mm: are units, axes and frame as said?",
        what, 1e3 * j.from_rest, 1e3 * out_of_reach));
}

}  // namespace

std::pair<double, double> plausible_scales(const Model& model) {
  const double line = TongueLine(model).length();
  std::pair scales{line / longest_line / slack, line / shortest_line * slack};
  // A model that is the speaker's own knows his size better than the 41 do.
  const double known = std::exp(far_size * model.description->scale_sd);
  return {std::max(scales.first, 1 / known), std::min(scales.second, known)};
}

Judgement judge(const Model& model, const Registration& r,
                const std::vector<std::vector<Vec2>>& contours, bool has_palate) {
  Judgement j{.scale = r.transform.scale,
              .tilt = std::remainder(r.transform.angle, 2 * std::numbers::pi),
              .shift = r.transform.shift,
              .palate_rms = r.palate_rms,
              .off_reach = r.off_reach};
  const std::vector<Vec2> rest = TongueLine(model).sample(at_anatomy(model)->rest, 60);
  std::vector<double> distances;
  for (const auto& contour : contours)
    distances.push_back(rms_distance(r.transform, contour, rest));
  j.from_rest = median(distances);
  std::vector<Vec3> moved;
  for (const auto& contour : contours)
    for (const Vec2& q : contour) {
      const Vec2 at = r.transform(q);
      moved.emplace_back(at[0], 0, at[1]);
    }
  j.behind_palate = behind(model, moved, into_bone + (has_palate ? 0 : r.shift_sd.maxCoeff()));

  if (std::abs(j.tilt) > most_tilt)
    j.faults.push_back(fmt::format(
        "it is tilted by {:.0f} degrees, and no head is by more than {:.0f}: is up where it was "
        "said to be (--y-grows, --facing, --axes)?",
        std::abs(j.tilt) * 180 / std::numbers::pi, most_tilt * 180 / std::numbers::pi));
  add_common_faults(model, j, r.free_scale, r.free_gain, has_palate, "contours");
  return j;
}

Judgement judge_scan(const Model& model, const std::vector<Vec3>& points,
                     const std::optional<ScanRegistration>& r, bool has_palate) {
  const double loose = r && !has_palate ? r->shift_sd : 0;
  Judgement j{.from_rest = rms_from_surface(facets(model.surface), at_anatomy(model)->rest, points),
              .behind_palate = behind(model, points, into_bone + loose)};
  if (r) {
    j.scale = r->pose.scale;
    j.palate_rms = r->palate_rms, j.off_reach = r->off_reach;
    if (j.off_reach > unlike)
      j.faults.push_back(fmt::format(
          "the scan lies {:.1f} mm (root mean square) from the surfaces that the model's muscles "
          "make, and at most {:.0f} mm will do: is it a tongue's, and are the units as said?",
          1e3 * j.off_reach, 1e3 * unlike));
  }
  add_common_faults(model, j, r ? r->free_scale : 1, r ? r->free_gain : 0, has_palate, "scan");
  return j;
}

}  // namespace genio
