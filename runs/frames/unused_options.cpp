#include "runs/frames/unused_options.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace genio {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& why) {
  throw InputError(fmt::format("{}: does not apply; {}", option, why));
}

void refuse_unless_sensors(const MeasuredOptions& o, const FormatTraits& format) {
  if (format.content == Content::sensors) return;
  const std::string why =
      fmt::format("{} is read as {}, which holds no sensors", o.target, format.name);
  if (!o.sensors.empty()) refuse("--sensors", why);
  if (o.read.rate_hz > 0) refuse("--rate-hz", why);
  if (!o.read.axes.empty() && format.content != Content::surface) refuse("--axes", why);
  if (!o.palate_sensor.empty()) refuse("--palate-sensor", why);
  if (!o.bite_plane_sensors.empty()) refuse("--bite-plane-sensors", why);
}

void refuse_of_scan(const MeasuredOptions& o, const FormatTraits& format) {
  if (format.content != Content::surface) return;
  const std::string why = fmt::format("{} is a scan, whose axes --axes tells", o.target);
  if (!o.read.facing.empty()) refuse("--facing", why);
  if (!o.read.up.empty()) refuse("--y-grows", why);
  const std::string place = o.target + " is a scan, which its palate's surface or its shape places";
  if (!o.bite_plane.empty()) refuse("--bite-plane", place);
  for (const auto& [point, text] : given_head_points(o))
    if (!text.empty()) refuse(option_of(point), place);
  if (!o.read.axes.empty() && o.registered)
    refuse("--axes", "--registered says that the file is in the model's frame already");
}

void refuse_axes(const MeasuredOptions& o, const FormatTraits& format) {
  const std::string why = fmt::format(
      "{} is read as {}, which is in millimetres and the model's frame", o.target, format.name);
  if (!o.read.units.empty()) refuse("--units", why);
  if (o.read.mm_per_px > 0) refuse("--mm-per-px", why);
  if (!o.read.facing.empty()) refuse("--facing", why);
  if (!o.read.up.empty()) refuse("--y-grows", why);
  if (!o.read.axes.empty()) refuse("--axes", why);
  if (!o.palate.empty()) refuse("--palate", why + " already");
  if (o.ignore_marks) refuse("--ignore-marks", why + " already");
  if (!o.bite_plane.empty()) refuse("--bite-plane", why + " already");
  for (const auto& [point, text] : given_head_points(o))
    if (!text.empty()) refuse(option_of(point), why + " already");
}

}  // namespace

void refuse_unused(const MeasuredOptions& o, const FormatTraits& format, bool registered) {
  refuse_unless_sensors(o, format);
  refuse_of_scan(o, format);
  if (registered) refuse_axes(o, format);
  if (!o.palate_sensor.empty() && o.palate.empty())
    refuse("--palate-sensor", "it is the sensor of the sweep that --palate gives");
  if (!o.bite_plane_sensors.empty() && o.bite_plane.empty())
    refuse("--bite-plane-sensors", "they are sensors of the recording that --bite-plane gives");
  if (!o.bite_plane.empty() && o.registered)
    refuse("--bite-plane", "--registered says that the file is in the model's frame already");
  for (const auto& [point, text] : given_head_points(o))
    if (!text.empty() && o.registered)
      refuse(option_of(point), "--registered says that the file is in the model's frame already");
  const bool shows_no_head = format.content != Content::curves || o.registered;
  if (o.ignore_marks && shows_no_head)
    refuse("--ignore-marks",
           "it leaves out what contours that are to be registered show of the head");
  if (!o.palate.empty() && o.registered)
    refuse("--palate", "--registered says that the file is in the model's frame already");
  if (o.read.mm_per_px > 0 && !o.read.units.empty() && o.read.units != "px")
    refuse("--mm-per-px", fmt::format("--units says {}", o.read.units));
}

void refuse_unused_pixels(const MeasuredOptions& o, const FileAxes& axes) {
  const bool pixels = axes.units.empty() || axes.units == "px" || o.read.units == "px";
  if (o.read.mm_per_px > 0 && !pixels)
    refuse("--mm-per-px",
           fmt::format("{} is in {} (--units px where it is not)", o.target, axes.units));
}

void refuse_unused_noise(const MeasuredOptions& o, const std::vector<ContourFrame>& frames) {
  if (!(o.noise_mm > 0)) return;
  for (const ContourFrame& frame : frames)
    for (const ContourPoint& p : frame.points)
      if (!(p.sigma > 0)) return;
  refuse("--noise-mm", o.target + " gives every point a noise of its own");
}

}  // namespace genio
