#pragma once
#include <array>

#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Samples of a flesh-point recording, one Vec3 a sensor and sample; not finite: missing.
struct SensorTable {
  std::vector<std::string> names;
  std::vector<std::vector<Vec3>> samples;
  double rate_hz = 0;
  std::vector<double> times_s = {};           ///< one a sample; empty: by the rate
  std::vector<std::vector<double>> rms = {};  ///< the device's residual, as samples; may be empty
  std::vector<std::string> labels = {};       ///< one a sample; may be empty
  std::string recording = {};                 ///< which take, where the file says it
  FileAxes axes = {"mm", "right", "up"};
  std::vector<std::string> remarks = {};
};

/// A frame a sample, of the sensors that the options name; what a sensor cannot have measured is
/// left out, and remarks say how much. Throws InputError that lists the sensors where none is
/// named.
RawContours sensor_frames(const std::string& path, SensorTable table, const ReadOptions& options);

/// The file's bytes. Throws InputError where there is no such file, or one beyond 2 GB.
std::string sensor_file_bytes(const std::string& path);

}  // namespace genio
