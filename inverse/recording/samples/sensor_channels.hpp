#pragma once
#include "inverse/recording/samples/sensor_frames.hpp"

namespace genio {

/// Sensors that scalar tracks make up: tracks whose names share a stem and end in x, y or z.
class SensorChannels {
 public:
  /// Names as in TTx_raw, TT_posx, tt_x, T3_py, TB-x[cm]. Derived tracks (TTx_filt, TTz_Vel) and
  /// stems with fewer than two coordinates make no sensor. The names number the tracks.
  explicit SensorChannels(const std::vector<std::string>& tracks);

  const std::vector<std::string>& names() const { return names_; }
  /// Positions from a sample's values, one a track. The coordinate that a sensor lacks is 0: two
  /// coordinates are the horizontal and the vertical one. Values that are not finite stay so.
  std::vector<Vec3> positions(const std::vector<double>& values) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::array<int, 3>> parts_;  // of each sensor: the track of x, y, z; -1: none
};

/// All zero and what is no number mean that a sensor was off: NaN.
Vec3 sensor_position(double x, double y, double z);

/// "1" to "count".
std::vector<std::string> numbered_sensors(size_t count);

}  // namespace genio
