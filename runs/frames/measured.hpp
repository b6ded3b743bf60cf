#pragma once
// Measured contours, read as the user describes them.

#include <functional>
#include <string>
#include <vector>

#include "forward/model/model.hpp"
#include "inverse/recording/contour_file.hpp"

namespace genio {

/// As the command line gives them; errors name its options.
struct MeasuredOptions {
  std::string target, palate, palate_sensor;
  std::string frames;                ///< "7" or "3-9"; empty: all
  std::vector<std::string> sensors;  ///< "5=tip"
  ReadOptions read;
  bool registered = false;  ///< already in the model's frame
  double noise_mm = 0;
};

struct Measured {
  std::vector<ContourFrame> frames;  ///< those asked for, in the model's frame
  double noise;                      ///< [m]
};

/// Reads, picks the frames and registers by the palate trace where the file is in the device's own
/// axes, with the model that `model` gives only then. `remark` hears what was taken for granted and
/// how well that went. Throws InputError naming file, field or option.
Measured read_measured(const MeasuredOptions& o, const std::function<const Model&()>& model,
                       const std::function<void(const std::string&)>& remark);

}  // namespace genio
