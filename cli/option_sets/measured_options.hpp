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

/// Of these what files do not say of their own form: --format to --palate-sensor, without --palate.
/// `only_with`: options without any of which they do nothing.
void add_reading_options(Options& options, MeasuredOptions& o,
                         const std::vector<std::string>& only_with = {});

/// And which frames, without --speaker.
void add_choice_options(Options& options, FrameChoice& choice,
                        const std::vector<std::string>& only_with = {});

}  // namespace genio::cli
