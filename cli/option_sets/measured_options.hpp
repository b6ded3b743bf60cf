#pragma once
#include "cli/command_line/options.hpp"
#include "runs/frames/measured.hpp"

namespace genio::cli {

/// Declares --target, --frames, --palate, --noise-mm, and what files do not say: --format, --units,
/// --mm-per-px, --facing, --y-grows, --sensors, --palate-sensor, --rate-hz, --registered,
/// --bite-plane, --hyoid, --short-tendon, --jaw-shadow, --ignore-marks, --columns, --spline; and
/// which frames: --frames, --textgrid, --tier,
/// --labels.
void add_measured_options(Options& options, MeasuredOptions& o);

}  // namespace genio::cli
