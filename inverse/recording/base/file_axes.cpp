#include "inverse/recording/base/file_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/base/median.hpp"

namespace genio {
namespace {

constexpr double shortest = 0.012, longest = 0.25;  // extent of what is measured of a tongue [m]
constexpr double stray_times = 3;  // times as far from a frame's middle as its next point

/// Diagonals of the frames' bounding boxes, the middle one.
double typical_extent(const ContourFile& file) {
  std::vector<double> extents;
  for (const ContourFrame& frame : file.frames) {
    if (frame.points.size() < 2) continue;
    Vec3 low = Vec3::Constant(1e30), high = -low;
    for (const ContourPoint& p : frame.points)
      for (int i = 0; i < 3; ++i)
        if (std::isfinite(p.position[i]))
          low[i] = std::min(low[i], p.position[i]), high[i] = std::max(high[i], p.position[i]);
    if (low[1] > high[1]) low[1] = high[1] = 0;
    extents.push_back((high - low).norm());
  }
  return median(std::move(extents));
}

/// The point that lies far from all others of its frame, where one does: "frame 3, point 7: (...)".
std::string stray_point(const ContourFile& file) {
  for (const ContourFrame& frame : file.frames) {
    if (frame.points.size() < 5) continue;
    std::vector<double> x, z;
    for (const ContourPoint& p : frame.points)
      x.push_back(p.position[0]), z.push_back(p.position[2]);
    const double middle_x = median(std::move(x)), middle_z = median(std::move(z));
    const auto off = [&](const ContourPoint& p) {
      return std::hypot(p.position[0] - middle_x, p.position[2] - middle_z);
    };
    std::vector<double> ways;
    for (const ContourPoint& p : frame.points) ways.push_back(off(p));
    std::nth_element(ways.begin(), ways.end() - 2, ways.end());
    for (size_t k = 0; k < frame.points.size(); ++k)
      if (off(frame.points[k]) > stray_times * ways[ways.size() - 2])
        return fmt::format("frame {}, point {}: ({:g}, {:g})", frame.number, k + 1,
                           frame.points[k].position[0], frame.points[k].position[2]);
  }
  return {};
}

double metres(const std::string& unit, const ReadOptions& o, const std::string& path) {
  if (const auto size = metres_a_unit(unit)) return *size;
  if (unit == "px") {
    if (!(o.mm_per_px > 0) || !std::isfinite(o.mm_per_px))
      throw InputError(path + ": is in pixels; give their size with --mm-per-px");
    return 1e-3 * o.mm_per_px;
  }
  throw InputError(fmt::format("--units {}: expected mm, cm, m, um or px", unit));
}

/// Metres a unit of the file.
double scale(ContourFile& file, const FileAxes& axes, const std::string& path,
             const ReadOptions& o) {
  const double extent = typical_extent(file);
  std::string unit = !o.units.empty() ? o.units : o.mm_per_px > 0 ? "px" : axes.units;
  const bool told = !unit.empty();
  if (!told && extent > 0)
    for (const auto& [name, size] :
         {std::pair{"mm", 1e-3}, std::pair{"m", 1.0}, std::pair{"cm", 1e-2}})
      if (unit.empty() && extent * size > 2 * shortest && extent * size < longest) unit = name;
  if (unit.empty() && extent > 0)
    throw InputError(fmt::format(
        "{}: contours of {:.4g} units are no tongue's in mm, cm or m; give --units or --mm-per-px",
        path, extent));
  if (unit.empty()) unit = "mm";
  const double size = metres(unit, o, path);
  const bool shape = file.format.content != Content::sensors;
  const bool small = shape && extent > 0 && extent * size < shortest;
  if (const bool large = extent > 0 && !(extent * size < longest); small || large)
    if (const std::string point = stray_point(file); !point.empty())
      throw InputError(fmt::format(
          "{}: {} lies far from the other points of its frame; was a decimal point lost?", path,
          point));
  if (small)
    throw InputError(
        fmt::format("{}: contours of {:.4g} mm in {}; a tongue's have 20 to 200 mm. Is each row a "
                    "frame where each column should be one, or are the units others (--units)?",
                    path, 1e3 * extent * size, unit));
  if (extent > 0 && !(extent * size < longest))
    throw InputError(fmt::format(
        "{}: contours of {:.4g} mm in {}; a tongue's have 20 to 200 mm{}", path,
        1e3 * extent * size, unit,
        unit == "px" ? fmt::format(". {:.4g} px are 80 mm at --mm-per-px {:.2g}: was the image "
                                   "enlarged, or are these several organs?",
                                   extent, 80 / extent)
                     : ""));
  file.units = unit;
  file.remarks.push_back(fmt::format("units {} ({}); contours span {:.0f} mm", unit,
                                     !told             ? "by their extent"
                                     : o.units.empty() ? "as the file has it"
                                                       : "as said",
                                     1e3 * extent * size));
  return size;
}

/// True where most contours bow towards falling y: upside down.
bool arches_down(const ContourFile& file) {
  int down = 0, up = 0;
  for (const ContourFrame& frame : file.frames) {
    const auto& p = frame.points;
    if (p.size() < 5) continue;
    double middle = 0;
    for (const ContourPoint& q : p) middle += q.position[2] / double(p.size());
    (middle < 0.5 * (p.front().position[2] + p.back().position[2]) ? down : up) += 1;
  }
  return down > up;
}

bool holds_curves(const ContourFile& file) { return file.format.content == Content::curves; }

/// From the sensor called `a` to that called `b`, summed over frames; 0 where not both are there.
Vec3 between(const ContourFile& file, const std::string& a, const std::string& b) {
  Vec3 sum = Vec3::Zero();
  for (const ContourFrame& frame : file.frames) {
    const auto at = [&](const std::string& name) {
      return std::find_if(frame.points.begin(), frame.points.end(),
                          [&](const ContourPoint& p) { return p.kind == name; });
    };
    const auto p = at(a), q = at(b);
    if (p != frame.points.end() && q != frame.points.end()) sum += q->position - p->position;
  }
  return sum;
}

/// Articulographs differ in which horizontal axis runs along the head: the one along which tip and
/// dorsum lie apart does. Sensors sit in the midsagittal plane, but heads are not held level to a
/// millimetre: what they say across it is dropped.
void put_sensors_along(ContourFile& file) {
  const Vec3 back = between(file, "tip", "dorsum");
  const bool turned = std::abs(back[1]) > std::abs(back[0]);
  for (ContourFrame& frame : file.frames)
    for (ContourPoint& p : frame.points) {
      if (turned) p.position[0] = p.position[1];
      p.position[1] = std::numeric_limits<double>::quiet_NaN();
    }
  if (turned) file.remarks.push_back("the second axis runs along the head (tip and dorsum)");
}

void check_choice(const std::string& value, const char* option, const char* a, const char* b) {
  if (!value.empty() && value != a && value != b)
    throw InputError(fmt::format("{} {}: expected {} or {}", option, value, a, b));
}

}  // namespace

std::optional<double> metres_a_unit(const std::string& unit) {
  if (unit == "mm") return 1e-3;
  if (unit == "cm") return 1e-2;
  if (unit == "m") return 1;
  if (unit == "um") return 1e-6;
  return {};
}

ContourFile in_metres(ContourFile file, const FileAxes& axes, const std::string& path,
                      const ReadOptions& o) {
  const double size = scale(file, axes, path, o);
  for (ContourFrame& frame : file.frames)
    for (ContourPoint& p : frame.points) p.position *= size, p.sigma *= size;
  return file;
}

void check_axes_options(const ReadOptions& o) {
  check_choice(o.facing, "--facing", "left", "right");
  check_choice(o.up, "--y-grows", "up", "down");
}

ContourFile in_model_axes(ContourFile file, const FileAxes& axes, const std::string& path,
                          const ReadOptions& o) {
  check_axes_options(o);
  file = in_metres(std::move(file), axes, path, o);
  if (file.format.content == Content::sensors) put_sensors_along(file);
  std::string up = !o.up.empty() ? o.up : axes.up;
  if (up.empty()) {
    up = holds_curves(file) && arches_down(file) ? "down" : "up";
    file.remarks.push_back(
        fmt::format("y grows {} ({})", up, holds_curves(file) ? "by the arch" : "assumed"));
  }
  std::string facing = !o.facing.empty() ? o.facing : axes.facing;
  if (const double d = between(file, "tip", "dorsum")[0]; o.facing.empty() && d != 0) {
    facing = d > 0 ? "left" : "right";
    file.remarks.push_back(fmt::format("face looks {} (the tip is there)", facing));
  } else if (!facing.empty()) {
    file.remarks.push_back(fmt::format("face looks {} ({})", facing,
                                       o.facing.empty() ? "as the format has it" : "as said"));
  }
  file.facing_known = !facing.empty();
  for (ContourFrame& frame : file.frames)
    for (ContourPoint& p : frame.points) {
      if (facing == "right") p.position[0] = -p.position[0];
      if (up == "down") p.position[2] = -p.position[2];
    }
  if (file.facing_known) remark_order(file);
  return file;
}

std::string points_order(const ContourFile& file) {
  int back = 0, front = 0;  // frames whose last point lies behind the first, or before it
  for (const ContourFrame& frame : file.frames) {
    const auto& p = frame.points;
    if (p.size() > 1) (p.back().position[0] > p.front().position[0] ? back : front) += 1;
  }
  if (back + front == 0 || !holds_curves(file)) return {};
  return back > front ? "tip to root" : "root to tip";
}

void remark_order(ContourFile& file) {
  if (const std::string order = points_order(file); !order.empty())
    file.remarks.push_back(fmt::format("points run from {} (which does not count)", order));
}

ContourFile mirrored(ContourFile file) {
  for (ContourFrame& frame : file.frames)
    for (ContourPoint& p : frame.points) p.position[0] = -p.position[0];
  return file;
}

}  // namespace genio
