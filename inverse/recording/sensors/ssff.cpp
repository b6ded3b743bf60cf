#include "inverse/recording/sensors/ssff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/samples/sensor_channels.hpp"

namespace genio {
namespace {

struct Column {
  std::string name;
  size_t count, bytes;  // values, and bytes of each
  bool floating;
};

struct Header {
  std::vector<Column> columns;
  double rate = 0, start = 0;
  size_t size = 0, record = 0;  // bytes
};

Header read_header(const std::string& bytes, const std::string& path) {
  const std::string rule = "-----------------\n";
  const auto end = bytes.find(rule);
  if (end == std::string::npos) throw InputError(path + ": its SSFF header does not end");
  Header h;
  h.size = end + rule.size();
  std::istringstream lines(bytes.substr(0, end));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "Record_Freq") words >> h.rate;
    if (word == "Start_Time") words >> h.start;
    if (word == "Machine" && words >> word && word != "IBM-PC")
      throw InputError(fmt::format("{}:{}: Machine {}; only IBM-PC (little endian) is read", path,
                                   number, word));
    if (word != "Column") continue;
    Column c;
    std::string type;
    double count = 0;
    words >> c.name >> type >> count;
    c.floating = type == "FLOAT" || type == "DOUBLE";
    c.bytes = type == "DOUBLE" ? 8 : type == "FLOAT" ? 4 : type == "LONG" ? 4 : 2;
    if ((!c.floating && type != "SHORT" && type != "LONG") || !(count >= 1 && count <= 1e5))
      throw InputError(
          fmt::format("{}:{}: expected Column NAME FLOAT|DOUBLE|SHORT|LONG COUNT", path, number));
    c.count = size_t(count);
    h.record += c.count * c.bytes;
    h.columns.push_back(c);
  }
  if (h.columns.empty()) throw InputError(path + ": its SSFF header has no Column");
  if (!(h.rate > 0)) throw InputError(path + ": its SSFF header has no Record_Freq above 0");
  return h;
}

double number(const char* at, const Column& c) {
  const auto as = [&]<class T>(T v) { return std::memcpy(&v, at, sizeof v), double(v); };
  return c.bytes == 8   ? as(double())
         : c.floating   ? as(float())
         : c.bytes == 4 ? as(int())
                        : as(short());
}

/// One file: its samples from `start_s` on.
struct Take {
  SensorTable table;
  double start_s = 0;
};

/// The names of all values of a record: x, y, z of a column with several.
std::vector<std::string> track_names(const Header& h) {
  std::vector<std::string> names;
  for (const Column& c : h.columns)
    for (size_t i = 0; i < c.count; ++i)
      names.push_back(c.count == 1                       ? c.name
                      : i < std::min<size_t>(3, c.count) ? c.name + "_" + "xyz"[i]
                                                         : "");
  return names;
}

Take read_one(const std::string& path) {
  const std::string bytes = sensor_file_bytes(path);
  if (!bytes.starts_with("SSFF"))
    throw InputError(path + ": is no SSFF file; only SSFF files are joined");
  const Header h = read_header(bytes, path);
  if (h.record > bytes.size() - h.size)  // before names of so many values are made
    throw InputError(
        fmt::format("{}: has no record: one takes {} bytes, and {} stand behind the "
                    "header",
                    path, h.record, bytes.size() - h.size));
  const SensorChannels sensors(track_names(h));
  if (sensors.names().empty()) {
    std::string columns;
    for (const Column& c : h.columns) columns += " " + c.name;
    throw InputError(fmt::format(
        "{}: its tracks{} make no sensor; expected TTx_raw, TTy_raw, TT_posx or the like", path,
        columns));
  }
  Take take{{sensors.names(), {}, h.rate}, h.start};
  for (size_t at = h.size; at + h.record <= bytes.size();) {
    std::vector<double> values;
    for (const Column& c : h.columns)
      for (size_t i = 0; i < c.count; ++i, at += c.bytes)
        values.push_back(number(bytes.data() + at, c));
    take.table.samples.push_back(sensors.positions(values));
  }
  if (const size_t rest = (bytes.size() - h.size) % h.record; rest != 0)
    take.table.remarks.push_back(fmt::format(
        "{} is cut short: {} whole records are read; the last {} bytes are no whole record of {}",
        path, take.table.samples.size(), rest, h.record));
  return take;
}

/// Adds the sensors of a file to those of the first, at the times of the first's samples.
void join(Take& all, const Take& more, const std::string& path) {
  for (const auto& name : more.table.names)
    if (std::find(all.table.names.begin(), all.table.names.end(), name) != all.table.names.end())
      throw InputError(fmt::format("{}: another of the files has a sensor {} as well", path, name));
  all.table.names.insert(all.table.names.end(), more.table.names.begin(), more.table.names.end());
  int met = 0;
  for (size_t s = 0; s < all.table.samples.size(); ++s) {
    const double t = all.start_s + double(s) / all.table.rate_hz;
    const double at = std::round((t - more.start_s) * more.table.rate_hz);
    const bool inside = at >= 0 && at < double(more.table.samples.size());
    met += inside;
    for (size_t k = 0; k < more.table.names.size(); ++k)
      all.table.samples[s].push_back(
          inside ? more.table.samples[size_t(at)][k]
                 : Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
  if (met == 0)
    throw InputError(path + ": has no sample at the times of the first file; is it another take?");
  if (size_t(met) < all.table.samples.size())
    all.table.remarks.push_back(fmt::format("{} has samples at {} of the first file's {} times",
                                            path, met, all.table.samples.size()));
  all.table.remarks.insert(all.table.remarks.end(), more.table.remarks.begin(),
                           more.table.remarks.end());
}

RawContours read(const std::string& path, const ReadOptions& o) {
  const auto paths = joined_paths(path);
  Take all = read_one(paths.front());
  for (size_t k = 1; k < paths.size(); ++k) join(all, read_one(paths[k]), paths[k]);
  for (size_t s = 0; s < all.table.samples.size(); ++s)
    all.table.times_s.push_back(all.start_s + double(s) / all.table.rate_hz);
  return sensor_frames(path, std::move(all.table), o);
}

std::string example() {
  std::string text =
      "SSFF -- (c) SHLRC\nMachine IBM-PC\nRecord_Freq 200.0\nStart_Time 0.0\n"
      "Column TTx_raw FLOAT 1\nColumn TTz_raw FLOAT 1\n-----------------\n";
  for (const float v : {12.5f, -3.25f}) text.append(reinterpret_cast<const char*>(&v), sizeof v);
  return text;
}

}  // namespace

std::vector<std::string> joined_paths(const std::string& path) {
  std::error_code e;
  if (std::filesystem::exists(path, e)) return {path};
  std::vector<std::string> paths;
  for (const auto& one : split_fields(path, ','))
    if (!trimmed(one).empty()) paths.push_back(trimmed(one));
  return paths.empty() ? std::vector{path} : paths;
}

ContourFormat ssff_format() {
  ReadOptions sensors;
  sensors.sensors = {{"TT", "tip"}};
  return {.traits = {.name = "ssff", .content = Content::sensors},
          .about = "SSFF tracks (EMU); files of one take are joined by commas",
          .known_by_bytes = [](const FileStart& start) { return start.bytes == "SSFF"; },
          .known_by_line = {},
          .read = read,
          .example = {.name = "take.tt", .text = example(), .options = sensors}};
}

}  // namespace genio
