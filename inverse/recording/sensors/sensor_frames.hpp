#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Samples of a flesh-point recording, one Vec3 a sensor and sample; not finite: missing.
struct SensorTable {
  std::vector<std::string> names;
  std::vector<std::vector<Vec3>> samples;
  double rate_hz = 0;
};

/// A frame a sample, of the sensors that the options name. Throws InputError that lists the sensors
/// where none is named.
RawContours sensor_frames(const std::string& path, const SensorTable& table,
                          const ReadOptions& options);

}  // namespace genio
