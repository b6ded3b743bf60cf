#include "cli/measured_options.hpp"

namespace genio::cli {

void add_measured_options(Options& options, MeasuredOptions& o) {
  options.add("--target", o.target, "Contour file");
  options.add("--format", o.read.format, "auto, csv, aaa, getcontours, edgetrak, ema or surface");
  options.add("--units", o.read.units, "mm, cm, m, um or px, where the file does not say");
  options.add("--mm-per-px", o.read.mm_per_px, "Size of a pixel", {.positive = true});
  options.add("--facing", o.read.facing, "Where the face looks in the file: left or right");
  options.add("--y-grows", o.read.up, "up, or down as in images");
  options.add("--sensors", o.sensors, "EMA: what each is stuck to, 3=dorsum,5=tip",
              {.separator = ','});
  options.add("--rate-hz", o.read.rate_hz, "EMA: samples a second, where the file does not say",
              {.positive = true});
  options.add("--palate", o.palate, "Palate trace of the same session");
  options.add("--palate-sensor", o.palate_sensor, "EMA: the sensor swept along the palate there");
  options.flag("--registered", o.registered, "The file is in the model's frame already");
  options.add("--frames", o.frames, "A-B, counted from 1");
  options.add("--noise-mm", o.noise_mm,
              "Measurement noise (default 0.5 for CSV and EMA, 1 for scans, 1.5 for ultrasound)");
}

}  // namespace genio::cli
