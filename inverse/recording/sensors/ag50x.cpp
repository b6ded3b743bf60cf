#include "inverse/recording/sensors/ag50x.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "inverse/recording/samples/sensor_channels.hpp"

namespace genio {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are read as they lie");

constexpr size_t values = 7;  // x y z phi theta rms extra, a channel
constexpr size_t ag500_channels = 12;
constexpr double ag500_rate = 200;  // [Hz]
constexpr double farthest = 2000;   // [mm] from the origin; the field reaches 300 mm

/// Value of `key` in an AG501 header; 0 where it is not there.
double header_number(const std::string& header, const std::string& key) {
  const auto at = header.find(key + "=");
  return at == std::string::npos ? 0 : std::atof(header.c_str() + at + key.size() + 1);
}

/// Samples from byte `first` on.
SensorTable samples(const std::string& bytes, size_t first, size_t channels, double rate,
                    const std::string& path) {
  const size_t size = channels * values * sizeof(float);
  const size_t there = bytes.size() - std::min(first, bytes.size());
  if (there < size)
    throw InputError(fmt::format("{}: {} bytes of samples; one of {} channels of 7 values has {}",
                                 path, there, channels, size));
  SensorTable table{numbered_sensors(channels), {}, rate};
  size_t strange = 0, given = 0;
  for (size_t at = first; at + size <= bytes.size(); at += size) {
    std::vector<float> v(channels * values);
    std::memcpy(v.data(), bytes.data() + at, size);
    auto& row = table.samples.emplace_back();
    auto& rms = table.rms.emplace_back();
    for (size_t c = 0; c < channels; ++c) {
      const float* p = v.data() + values * c;
      row.push_back(sensor_position(p[0], p[1], p[2]));
      rms.push_back(p[5]);
      if (!row.back().allFinite()) continue;
      ++given;
      if (row.back().norm() > farthest) ++strange, row.back().setConstant(std::nan(""));
    }
  }
  if (10 * strange > given)
    throw InputError(
        fmt::format("{}: {} of {} positions are farther than {:.0f} mm from the origin; these are "
                    "no samples of {} channels of 7 floats",
                    path, strange, given, farthest, channels));
  if (strange > 0)
    table.remarks.push_back(
        fmt::format("{} of {} positions are farther than {:.0f} mm from the "
                    "origin; left out",
                    strange, given, farthest));
  if (there % size != 0)
    table.remarks.push_back(
        fmt::format("the file is cut short: {} whole samples are read; the last {} bytes are no "
                    "whole sample of {} bytes",
                    there / size, there % size, size));
  return table;
}

SensorTable read_ag501(const std::string& bytes, const std::string& path) {
  const auto line = bytes.find('\n');
  const double size = line == std::string::npos ? 0 : std::atof(bytes.c_str() + line + 1);
  const std::string header =
      size > 0 ? bytes.substr(0, size_t(std::min(double(bytes.size()), size))) : "";
  const double channels = header_number(header, "NumberOfChannels"),
               rate = header_number(header, "SamplingFrequencyHz");
  if (!(size > 0 && size < 1e6 && channels >= 1 && channels <= 1000 && rate > 0))
    throw InputError(path +
                     ": its AG50x header tells no size, NumberOfChannels or "
                     "SamplingFrequencyHz");
  return samples(bytes, size_t(size), size_t(channels), rate, path);
}

RawContours read(const std::string& path, const ReadOptions& o) {
  const std::string bytes = sensor_file_bytes(path);
  return sensor_frames(path,
                       bytes.starts_with("AG50x")
                           ? read_ag501(bytes, path)
                           : samples(bytes, 0, ag500_channels, ag500_rate, path),
                       o);
}

std::string example() {
  std::string text = "AG50xDATA_V003\n00000070\nNumberOfChannels=1\nSamplingFrequencyHz=250\n";
  text += std::string("\0\x1a", 2);
  text.resize(70, '\0');
  for (const float v : {12.5f, 1.0f, -3.25f, 0.0f, 0.0f, 3.0f, 0.0f})
    text.append(reinterpret_cast<const char*>(&v), sizeof v);
  return text;
}

}  // namespace

ContourFormat ag50x_format() {
  ReadOptions sensors;
  sensors.sensors = {{"1", "tip"}};
  return {
      .traits = {.name = "ag50x", .content = Content::sensors},
      .about = "Carstens AG500 and AG501 .pos",
      .known_by_bytes =
          [](const FileStart& start) { return start.bytes == "AG50" || start.ending == ".pos"; },
      .known_by_line = {},
      .read = read,
      .example = {.name = "sweep.pos", .text = example(), .options = sensors}};
}

}  // namespace genio
