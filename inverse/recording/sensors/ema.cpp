#include "inverse/recording/sensors/ema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/sensors/sensor_frames.hpp"
#include "inverse/recording/sensors/ssff.hpp"

namespace genio {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are read as they lie");

constexpr size_t values = 7;  // x y z phi theta rms extra, a channel
constexpr int ag500_channels = 12;
constexpr double ag500_rate = 200;  // [Hz]
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::string whole_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": no such file");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A position; all zero and what is no number mean that the sensor was off.
Vec3 position(double x, double y, double z) {
  const Vec3 p(x, y, z);
  return p.allFinite() && !p.isZero(0) ? p : Vec3::Constant(missing);
}

std::vector<std::string> numbered(size_t count) {
  std::vector<std::string> names;
  for (size_t k = 1; k <= count; ++k) names.push_back(std::to_string(k));
  return names;
}

/// Value of `key` in an AG501 header; 0 where it is not there.
double header_number(const std::string& header, const std::string& key) {
  const auto at = header.find(key + "=");
  return at == std::string::npos ? 0 : std::atof(header.c_str() + at + key.size() + 1);
}

/// Little-endian 32-bit floats, sample by sample, from byte `first` on.
SensorTable samples(const std::string& bytes, size_t first, size_t channels, double rate,
                    const std::string& path) {
  const size_t size = channels * values * sizeof(float);
  if (bytes.size() <= first || (bytes.size() - first) % size != 0)
    throw InputError(
        fmt::format("{}: {} bytes of samples; {} channels of 7 values need a multiple of {}", path,
                    bytes.size() - std::min(first, bytes.size()), channels, size));
  SensorTable table{numbered(channels), {}, rate};
  for (size_t at = first; at < bytes.size(); at += size) {
    std::vector<float> v(channels * values);
    std::memcpy(v.data(), bytes.data() + at, size);
    auto& row = table.samples.emplace_back();
    for (size_t c = 0; c < channels; ++c)
      row.push_back(position(v[values * c], v[values * c + 1], v[values * c + 2]));
  }
  return table;
}

SensorTable read_ag501(const std::string& bytes, const std::string& path) {
  const auto line = bytes.find('\n');
  const double size = line == std::string::npos ? 0 : std::atof(bytes.c_str() + line + 1);
  const std::string header = bytes.substr(0, std::min(bytes.size(), size_t(std::max(0.0, size))));
  const double channels = header_number(header, "NumberOfChannels"),
               rate = header_number(header, "SamplingFrequencyHz");
  if (!(size > 0 && channels >= 1 && channels <= 1000 && rate > 0))
    throw InputError(path +
                     ": its AG50x header tells no size, NumberOfChannels or "
                     "SamplingFrequencyHz");
  return samples(bytes, size_t(size), size_t(channels), rate, path);
}

/// AG501's text export: seven columns a channel, with or without a header.
SensorTable read_text(const std::string& path) {
  TableLines lines(path);
  SensorTable table;
  for (std::string line; lines.next(line);) {
    if (trimmed(line).empty()) continue;
    auto fields = split_fields(line, '\t');
    if (!fields.empty() && trimmed(fields.back()).empty()) fields.pop_back();
    if (fields.size() % values != 0 || fields.empty())
      lines.fail(fmt::format("{} fields; expected 7 a channel", fields.size()));
    if (table.names.empty()) table.names = numbered(fields.size() / values);
    if (fields.size() != values * table.names.size())
      lines.fail(fmt::format("{} fields; the first row has {}", fields.size(),
                             values * table.names.size()));
    if (fields.front().starts_with("Ch")) continue;
    auto& row = table.samples.emplace_back();
    for (size_t c = 0; c < table.names.size(); ++c) {
      double v[3];
      for (size_t i = 0; i < 3; ++i)
        if (!parse_number(fields[values * c + i], v[i])) v[i] = missing;
      row.push_back(position(v[0], v[1], v[2]));
    }
  }
  if (table.samples.empty()) lines.fail("the file has no sample");
  return table;
}

RawContours read(const std::string& path, const ReadOptions& o) {
  const std::string bytes = whole_file(path);
  if (bytes.starts_with("SSFF")) return read_ssff(path, o);
  if (bytes.starts_with("AG50x")) return sensor_frames(path, read_ag501(bytes, path), o);
  // Floats hold bytes that no text has.
  const std::string start = bytes.substr(0, 200);
  const bool text = std::all_of(start.begin(), start.end(), [](char c) {
    return c == '\t' || c == '\n' || c == '\r' || (c >= ' ' && c <= '~');
  });
  if (text) return sensor_frames(path, read_text(path), o);
  return sensor_frames(path, samples(bytes, 0, ag500_channels, ag500_rate, path), o);
}

bool known_by_bytes(const FileStart& start) {
  return start.bytes == "SSFF" || start.bytes == "AG50" || start.ending == ".pos";
}

bool known_by_line(const FileStart& start) { return start.line.find("Ch1_X") != std::string::npos; }

}  // namespace

ContourFormat ema_format() {
  ReadOptions sensors;
  sensors.sensors = {{"1", "tip"}};
  return {.traits = {.name = "ema", .content = Content::sensors},
          .about = "AG500 and AG501 .pos, AG501 text, SSFF",
          .known_by_bytes = known_by_bytes,
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "sweep.txt",
                      .text = "Ch1_X\tCh1_Y\tCh1_Z\tCh1_phi\tCh1_theta\tCh1_RMS\tCh1_Extra\n"
                              "12.5\t1\t-3.25\t0\t0\t0\t0\n",
                      .options = sensors}};
}

}  // namespace genio
