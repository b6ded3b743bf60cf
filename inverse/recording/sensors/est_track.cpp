#include "inverse/recording/sensors/est_track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/samples/sensor_channels.hpp"

namespace genio {
namespace {

constexpr size_t before = 2;  // time and flag
constexpr double hundredth = 0.01;

/// In the order of the tracks that MOCHA distributes.
const std::vector<std::string>& mocha_channels() {
  static const std::vector<std::string> names = {
      "ui_x", "li_x", "ul_x", "ll_x", "tt_x", "ui_y", "li_y", "ul_y", "ll_y", "tt_y",
      "tb_x", "td_x", "v_x",  "****", "bn_x", "tb_y", "td_y", "v_y",  "****", "bn_y"};
  return names;
}

struct Header {
  std::vector<std::string> channels;
  bool ascii = false, swapped = false;
  size_t frames = 0, size = 0;  // samples said; bytes of the header
};

Header read_header(const std::string& bytes, const std::string& path) {
  const std::string last = "EST_Header_End";
  const auto end = bytes.find(last);
  if (end == std::string::npos) throw InputError(path + ": its EST header does not end");
  const auto line_end = bytes.find('\n', end);
  Header h;
  h.size = line_end == std::string::npos ? bytes.size() : line_end + 1;
  std::istringstream lines(bytes.substr(0, end));
  double channels = 0, frames = 0;
  std::vector<std::pair<double, std::string>> names;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, value;
    words >> key >> value;
    if (key == "DataType") h.ascii = value == "ascii";
    else if (key == "ByteOrder") h.swapped = value == "10";
    else if (key == "NumFrames") frames = std::atof(value.c_str());
    else if (key == "NumChannels") channels = std::atof(value.c_str());
    else if (key.starts_with("Channel_")) names.emplace_back(std::atof(key.c_str() + 8), value);
  }
  if (!(channels >= 1 && channels <= 1e4) || !(frames >= 0 && frames <= 1e9))
    throw InputError(path + ": its EST header has no NumChannels from 1 to 10000 and NumFrames");
  h.frames = size_t(frames);
  h.channels.resize(size_t(channels));
  for (const auto& [k, name] : names)
    if (k >= 0 && k < channels) h.channels[size_t(k)] = name;
  return h;
}

/// Adds a sample of time, flag and a value a channel.
void add(SensorTable& table, const SensorChannels& sensors, const std::vector<double>& v,
         double scale) {
  table.times_s.push_back(v[0]);
  auto& row = table.samples.emplace_back(sensors.positions({v.begin() + before, v.end()}));
  for (Vec3& p : row) p *= scale;
}

void read_binary(SensorTable& table, const SensorChannels& sensors, const Header& h,
                 const std::string& bytes, const std::string& path) {
  const size_t width = h.channels.size() + before, size = width * sizeof(float);
  const size_t there = bytes.size() - h.size, count = there / size;
  for (size_t s = 0; s < count; ++s) {
    std::vector<double> v;
    for (size_t k = 0; k < width; ++k) {
      char word[sizeof(float)];
      std::memcpy(word, bytes.data() + h.size + s * size + k * sizeof(float), sizeof word);
      if (h.swapped) std::reverse(word, word + sizeof word);
      float value = 0;
      std::memcpy(&value, word, sizeof value);
      v.push_back(value);
    }
    if (!std::isfinite(v[0]) || std::abs(v[0]) > 1e6)
      throw InputError(fmt::format("{}: sample {} has no time; expected seconds", path, s + 1));
    add(table, sensors, v, 1);
  }
  if (there % size != 0 || (h.frames > 0 && count != h.frames))
    table.remarks.push_back(fmt::format(
        "the file is cut short or longer than it says: {} whole samples are read, its header says "
        "{}; {} bytes are left over",
        count, h.frames, there % size));
}

void read_rows(SensorTable& table, const SensorChannels& sensors, TableLines& lines, size_t width,
               double scale) {
  TableNumbers numbers('\t');
  for (std::string line; lines.next(line);) {
    const auto fields = sensor_fields(line);
    if (fields.empty()) continue;
    std::vector<double> v;
    for (const auto& field : fields) {  // the time and the flag stand between tabs, the rest not
      std::istringstream words(field);
      for (std::string word; words >> word;) v.push_back(numbers.value(word, lines));
    }
    if (v.size() != width)
      lines.fail(
          fmt::format("{} fields; expected time, flag and {} channels", v.size(), width - before));
    if (!std::isfinite(v[0])) lines.fail("no time in the first column");
    add(table, sensors, v, scale);
  }
}

/// MOCHA's numbers are 1/100 mm: a tongue's sensors spread far beyond what millimetres allow.
double unit_of(const SensorTable& table) {
  double largest = 0;
  for (const auto& row : table.samples)
    for (const Vec3& p : row)
      if (p.allFinite()) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest > 1000 ? hundredth : 1;
}

void check(const SensorTable& table, const std::string& path) {
  if (table.names.empty())
    throw InputError(path + ": no two of its channels are named x, y or z of one sensor");
}

RawContours read(const std::string& path, const ReadOptions& o) {
  const std::string bytes = sensor_file_bytes(path);
  const Header h = read_header(bytes, path);
  const SensorChannels sensors(h.channels);
  SensorTable table{sensors.names(), {}};
  table.axes = {"mm", "", ""};
  if (h.ascii) {
    TableLines lines(path);
    for (std::string line; lines.next(line) && !line.starts_with("EST_Header_End");) {
    }
    read_rows(table, sensors, lines, h.channels.size() + before, 1);
  } else read_binary(table, sensors, h, bytes, path);
  check(table, path);
  const double unit = unit_of(table);
  for (auto& row : table.samples)
    for (Vec3& p : row) p *= unit;
  if (unit != 1) table.remarks.push_back("positions are taken for 1/100 mm, by their size");
  return sensor_frames(path, std::move(table), o);
}

RawContours read_mocha(const std::string& path, const ReadOptions& o) {
  TableLines lines(path);
  const SensorChannels sensors(mocha_channels());
  SensorTable table{sensors.names(), {}};
  table.axes = {"mm", "left", "up"};
  read_rows(table, sensors, lines, mocha_channels().size() + before, hundredth);
  check(table, path);
  table.remarks.push_back("channels are taken for MOCHA's 20 in the order of its tracks, 1/100 mm");
  return sensor_frames(path, std::move(table), o);
}

bool known_by_line(const FileStart& start) {
  std::istringstream words(start.line);
  std::vector<std::string> fields;
  for (std::string word; words >> word && fields.size() < 30;) fields.push_back(word);
  double flag = 0;
  return fields.size() == mocha_channels().size() + before &&
         (start.ending == ".ema" || start.sensors_named) &&
         std::all_of(fields.begin(), fields.end(), is_value) && parse_number(fields[1], flag) &&
         (flag == 0 || flag == 1);
}

}  // namespace

ContourFormat est_track_format() {
  ReadOptions sensors;
  sensors.sensors = {{"tt", "tip"}};
  return {.traits = {.name = "est", .content = Content::sensors},
          .about = "EST_Track of MOCHA and mngu0",
          .known_by_bytes = [](const FileStart& start) { return start.bytes == "EST_"; },
          .known_by_line = {},
          .read = read,
          .example = {.name = "fsew0_001.ema",
                      .text = "EST_File Track\nDataType ascii\nNumFrames 1\nNumChannels 2\n"
                              "EqualSpace 1\nChannel_0 tt_x\nChannel_1 tt_y\nEST_Header_End\n"
                              "0.002\t1\t12.5 -3.25\n",
                      .options = sensors}};
}

ContourFormat mocha_format() {
  ReadOptions sensors;
  sensors.sensors = {{"tt", "tip"}};
  return {.traits = {.name = "mocha", .content = Content::sensors},
          .about = "MOCHA tracks as text",
          .known_by_bytes = {},
          .known_by_line = known_by_line,
          .read = read_mocha,
          .example = {.name = "fsew0_001.ema",
                      .text = "0.002\t1\t1 2 3 4 500 1 2 3 4 900 1500 2500 3 4 5 1000 1100 3 4 5\n",
                      .options = sensors}};
}

}  // namespace genio
