#include "runs/results/laid.hpp"

#include <fmt/format.h>

#include <cmath>

#include "runs/text/csv_text.hpp"
#include "runs/text/json_values.hpp"

namespace genio {
namespace {

/// ", RMS 0.31 mm", or nothing.
std::string told(const char* before, double value, int decimals, const char* after) {
  return std::isnan(value) ? "" : fmt::format("{}{:.{}f}{}", before, value, decimals, after);
}

}  // namespace

Laid laid_in(const nlohmann::json& registration) {
  const nlohmann::json r = registration.is_object() ? registration : nlohmann::json::object();
  Laid laid{.scale = number(r, "scale"),
            .tilt_deg = number(r, "tilt_deg"),
            .shift_back_mm = std::nan(""),
            .shift_up_mm = std::nan(""),
            .palate_rms_mm = number(r, "palate_rms_mm"),
            .from_rest_mm = number(r, "from_rest_mm"),
            .off_reach_mm = number(r, "off_reach_mm"),
            .behind_palate = number(r, "behind_palate"),
            .units = word(r, "units"),
            .axes = word(r, "axes"),
            .points_order = word(r, "points_order"),
            .by = word(r, "by"),
            .doubtful = flag(r, "doubtful"),
            .forced = flag(r, "forced")};
  if (const auto shift = r.find("shift_mm"); shift != r.end() && shift->is_array() &&
                                             shift->size() == 2 && (*shift)[0].is_number() &&
                                             (*shift)[1].is_number())
    laid.shift_back_mm = (*shift)[0].get<double>(), laid.shift_up_mm = (*shift)[1].get<double>();
  return laid;
}

Laid laid_in(const std::string& registration) {
  return laid_in(nlohmann::json::parse(registration, nullptr, false));
}

std::string laid_titles() {
  return "registration_scale,registration_tilt_deg,registration_palate_rms_mm,"
         "registration_doubtful,registration_forced,registration_by,registration_shift_back_mm,"
         "registration_shift_up_mm,registration_from_rest_mm,registration_off_reach_mm,"
         "registration_behind_palate,registration_units,registration_axes,"
         "registration_points_order";
}

std::string laid_fields(const Laid& l) {
  std::string text = fmt::format("{},{},{},{},{},{}", csv_number(l.scale, 4),
                                 csv_number(l.tilt_deg, 4), csv_number(l.palate_rms_mm, 4),
                                 l.doubtful ? "yes" : "no", l.forced ? "yes" : "no", l.by);
  for (const double value :
       {l.shift_back_mm, l.shift_up_mm, l.from_rest_mm, l.off_reach_mm, l.behind_palate})
    text += "," + csv_number(value, 4);
  for (const std::string& what : {l.units, l.axes, l.points_order}) text += "," + csv_field(what);
  return text;
}

std::vector<std::string> laid_words(const Laid& l) {
  if (l.by.empty()) return {};
  std::string where = l.doubtful ? "DOUBTFUL: " : "";
  if (l.by == "given") where += "in the model's frame as given";
  else {
    where += fmt::format("registered by the {}: scale {:.2f}, tilt {:.1f} degrees", l.by, l.scale,
                         l.tilt_deg);
    if (!std::isnan(l.shift_up_mm))
      where +=
          fmt::format(", shift {:.0f} mm back and {:.0f} mm up", l.shift_back_mm, l.shift_up_mm);
    where += told(", palate RMS ", l.palate_rms_mm, 2, " mm");
  }
  std::string read = told("", l.from_rest_mm, 1, " mm from rest") +
                     told(", ", l.off_reach_mm, 1, " mm from the tongue's reach");
  if (!l.units.empty()) read += "; units " + l.units;
  if (!l.axes.empty()) read += "; axes " + l.axes;
  if (!l.points_order.empty()) read += "; points " + l.points_order;
  return {where, read};
}

}  // namespace genio
