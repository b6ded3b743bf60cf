#pragma once
// Measured contours as the command line names them.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "forward/model/model.hpp"
#include "inverse/recording/contour_file.hpp"
#include "report/answer_report.hpp"

namespace genio::cli {

struct MeasuredOptions {
  std::string target, palate, palate_sensor, frames;
  std::vector<std::string> sensors;  ///< "5=tip"
  ReadOptions read;
  bool registered = false;  ///< already in the model's frame
  double noise_mm = 0;
};

/// Declares --target, --frames, --palate, --noise-mm, and what files do not say: --format, --units,
/// --mm-per-px, --facing, --y-grows, --sensors, --palate-sensor, --rate-hz, --registered.
void add_measured_options(CLI::App& app, MeasuredOptions& o);

struct Measured {
  std::vector<ContourFrame> frames;  ///< those asked for, in the model's frame
  double noise;                      ///< [m]
};

/// Reads, picks the frames and registers by the palate trace where the file is in the device's own
/// axes, with the model that `model` gives only then; says on standard error how well that went.
/// Throws InputError naming file, field or option.
Measured read_measured(const MeasuredOptions& o, const std::function<const Model&()>& model);

/// One JSON object a line, or the table with its title, at once on standard output.
void print_answer(const AnswerView& view, int frame, bool json);

/// "frame00007", for its files.
std::string frame_name(const ContourFrame& frame);
/// "frame 7: word"
std::string frame_title(const ContourFrame& frame);

}  // namespace genio::cli
