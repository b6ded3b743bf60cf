#pragma once
// Recordings of the model itself, as devices write them.

#include <map>
#include <random>
#include <string>
#include <vector>

#include "forward/model/model.hpp"
#include "inverse/recording/base/axes_reading.hpp"
#include "inverse/recording/registration/registration.hpp"
#include "runs/frames/measured.hpp"

namespace genio::bench {

/// How a device writes what it measures.
enum class Device { aaa, edgetrak, getcontours, articulograph, table };

/// A recording before it is written: points of each frame and of the palate in the midsagittal
/// plane, and what the device makes of them.
struct SyntheticSession {
  Device device = Device::aaa;
  std::vector<std::vector<Vec2>> frames;  ///< (x back, z up) in the model's frame [m]
  std::vector<std::map<std::string, double>> forces = {};  ///< of each, by bilateral name [N]
  std::vector<Vec2> palate;                                ///< the same; sensors are swept along it
  Similarity target_to_device, palate_to_device;           ///< alike but where a palate was swapped
  AxesReading target_axes, palate_axes;                    ///< of the files
  double target_unit = 1e-3, palate_unit = 1e-3;           ///< [m] of a number in them
};

/// Draws one: postures of two to five muscles, a speaker's size, a head's tilt and noise.
SyntheticSession draw_session(const Model& model, Device device, std::mt19937& random,
                              int frames = 3);

/// Text of the files and the options that their owner would give. `target` and `palate` are names.
struct WrittenSession {
  std::string target, palate, target_text, palate_text;
  MeasuredOptions options;  ///< paths are the caller's to set
};
WrittenSession written(const SyntheticSession& session);

}  // namespace genio::bench
