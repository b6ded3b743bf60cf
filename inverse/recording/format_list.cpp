#include "inverse/recording/format_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "forward/base/input_file.hpp"
#include "forward/base/nearest_name.hpp"
#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/curves/aaa.hpp"
#include "inverse/recording/curves/columns.hpp"
#include "inverse/recording/curves/csv.hpp"
#include "inverse/recording/curves/deeplabcut.hpp"
#include "inverse/recording/curves/edgetrak.hpp"
#include "inverse/recording/curves/getcontours.hpp"
#include "inverse/recording/curves/usc_pts.hpp"
#include "inverse/recording/scans/scan.hpp"
#include "inverse/recording/sensors/ema.hpp"
#include "inverse/recording/sensors/ssff.hpp"
#include "inverse/recording/sensors/xrmb.hpp"

namespace genio {
namespace {

std::string ending(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

std::string first_bytes(const std::string& path) {
  check_input(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": cannot be read");
  std::string bytes(4, '\0');
  in.read(bytes.data(), 4);
  return bytes.substr(0, size_t(in.gcount()));
}

/// The name for whichever format of sensors a file has.
ContourFormat ema_format() {
  ContourFormat format;
  format.traits = {.name = "ema", .content = Content::sensors};
  format.about = "any of the formats of sensors";
  format.read = [](const std::string& path, const ReadOptions& o) {
    const ContourFormat& found = format_of(path, o);
    if (found.traits.content != Content::sensors)
      throw InputError(
          fmt::format("{}: is of format {}, not a recording of sensors", path, found.traits.name));
    return found.read(path, o);
  };
  return format;
}

}  // namespace

const std::vector<ContourFormat>& contour_formats() {
  // A format that knows its files by less stands below those that know theirs by more.
  static const std::vector<ContourFormat> formats = [] {
    std::vector<ContourFormat> all = sensor_formats();
    for (const ContourFormat& format :
         {scan_format(), xrmb_palate_format(), getcontours_format(), deeplabcut_format(),
          usc_pts_format(), edgetrak_format(), columns_format(), aaa_format(), csv_format()})
      all.push_back(format);
    return all;
  }();
  return formats;
}

const ContourFormat& format_named(const std::string& name) {
  static const ContourFormat any_sensors = ema_format();
  if (name == any_sensors.traits.name) return any_sensors;
  std::vector<std::string> names = {"auto", any_sensors.traits.name};
  for (const ContourFormat& format : contour_formats()) {
    if (format.traits.name == name) return format;
    names.push_back(format.traits.name);
  }
  throw InputError(fmt::format("--format {}: unknown; did you mean {}? Expected {}", name,
                               nearest_name(name, names), format_choices()));
}

const ContourFormat& format_of(const std::string& path, const ReadOptions& options) {
  const std::string file = joined_paths(path).front();
  FileStart start{ending(file), first_bytes(file), {}, {}};
  start.sensors_named = !options.sensors.empty();
  for (const ContourFormat& format : contour_formats())
    if (format.known_by_bytes && format.known_by_bytes(start)) return format;
  TableLines lines(file);
  lines.next_filled(start.line);
  const int first = lines.number();
  for (std::string line; start.more.size() < 3 && lines.next_filled(line);)
    start.more.push_back(line);
  if (start.sensors_named) {
    if (const ContourFormat* format = sensor_format_of(start)) return *format;
    throw InputError(fmt::format(
        "{}:{}: sensors are named, but it is no recording of sensors that is known; leave "
        "--sensors out, or give --format",
        path, std::max(1, first)));
  }
  for (const ContourFormat& format : contour_formats())
    if (format.known_by_line && format.known_by_line(start)) return format;
  throw InputError(fmt::format(
      "{}:{}: neither tab-separated (AAA, GetContours) nor comma-separated (CSV), nor a file of "
      "points known by its first bytes, lines or ending; give --format, or name the columns of a "
      "table with --columns",
      path, std::max(1, first)));
}

std::string format_choices() {
  std::string choices = "auto, ema";
  for (const ContourFormat& format : contour_formats())
    choices += (&format == &contour_formats().back() ? " or " : ", ") + format.traits.name;
  return choices;
}

}  // namespace genio
