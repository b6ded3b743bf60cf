#pragma once
// Measured contours as the command line names them.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "forward/model.hpp"
#include "inverse/contour_file.hpp"

namespace genio::cli {

struct MeasuredOptions {
  std::string target, format = "auto", palate, frames;
  double noise_mm = 0;
};

/// Declares --target, --format, --palate, --frames and --noise-mm.
void add_measured_options(CLI::App& app, MeasuredOptions& o);

struct Measured {
  std::vector<ContourFrame> frames;  ///< those asked for, in the model's frame
  double noise;                      ///< [m]
};

/// Reads, picks the frames and registers by the palate trace where the file is in the device's own
/// axes; says on standard error how well that went. Throws InputError naming file, field or option.
Measured read_measured(const Model& model, const MeasuredOptions& o);

/// "frame 7: word"
std::string frame_title(const ContourFrame& frame);

}  // namespace genio::cli
