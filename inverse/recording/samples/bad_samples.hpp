#pragma once
#include "inverse/recording/samples/sensor_frames.hpp"

namespace genio {

/// Sets samples of sensor `c` that it cannot have measured to NaN, and remarks how many there were
/// and why: a residual far above the sensor's usual one; the same position while another sensor
/// moves (`frozen`); steps that others take no part in and no tongue makes.
void drop_bad_samples(SensorTable& table, size_t c, bool on_tongue);

}  // namespace genio
