#include "cli/option_sets/measured_options.hpp"

#include <fmt/format.h>

#include "inverse/recording/format_list.hpp"

namespace genio::cli {
namespace {

/// "ema 0.5, surface 1, ...": what is assumed of each format [mm].
std::string usual_noises() {
  std::string list;
  for (const ContourFormat& format : contour_formats())
    list += fmt::format("{}{} {:g}", list.empty() ? "" : ", ", format.traits.name,
                        1e3 * format.traits.noise);
  return list;
}

}  // namespace

void add_reading_options(Options& options, MeasuredOptions& o,
                         const std::vector<std::string>& only_with) {
  const std::vector<std::string> units = {"mm", "cm", "m", "um", "px"};
  const std::vector<std::string> palates = {"--palate"};
  const std::vector<std::string>& of_palate = only_with.empty() ? palates : only_with;
  std::vector<std::string> formats = {"auto"};
  for (const ContourFormat& format : contour_formats()) formats.push_back(format.traits.name);
  options.add("--format", o.read.format, format_choices(),
              {.suggested = formats, .only_with = only_with});
  options.add("--columns", o.columns,
              "Columns of any long table: x=TITLE,y=TITLE,frame=TITLE,time=...,recording=...",
              {.separator = ',', .only_with = only_with});
  options.add("--spline", o.read.spline, "The spline, or the body parts, to take of several",
              {.only_with = only_with});
  options.add("--points", o.read.points, "A-B: the landmarks of a .pts file that are the tongue's",
              {.only_with = only_with});
  options.add("--units", o.read.units, "mm, cm, m, um or px, where the file does not say",
              {.suggested = units, .only_with = only_with});
  options.add("--mm-per-px", o.read.mm_per_px, "Size of a pixel",
              {.positive = true, .only_with = only_with});
  options.add("--facing", o.read.facing, "Where the face looks in the file: left or right",
              {.suggested = {"left", "right"}, .only_with = only_with});
  options.add("--y-grows", o.read.up, "up, or down as in images",
              {.suggested = {"up", "down"}, .only_with = only_with});
  options.add("--axes", o.read.axes,
              "EMA and scans: the axis that runs back along the head and the one that runs up, as "
              "in -x+z",
              {.only_with = only_with});
  options.add("--sensors", o.sensors,
              "EMA: what each is stuck to, 1=tip+3mm,2=tip+13mm,3=dorsum (see genio info)",
              {.separator = ',', .only_with = only_with});
  options.add("--rate-hz", o.read.rate_hz, "EMA: samples a second, where the file does not say",
              {.positive = true, .only_with = only_with});
  options.add("--palate-format", o.palate_format,
              "Its format, where it is another than the target's",
              {.suggested = formats, .only_with = of_palate});
  options.add("--palate-units", o.palate_units,
              "Its units, where they are others than the target's",
              {.suggested = units, .only_with = of_palate});
  options.add("--palate-spline", o.palate_spline, "The spline to take there, of several",
              {.only_with = of_palate});
  options.add("--palate-sensor", o.palate_sensor, "EMA: the sensor swept along the palate there",
              {.only_with = of_palate});
}

void add_choice_options(Options& options, FrameChoice& choice,
                        const std::vector<std::string>& only_with) {
  options.add("--frames", choice.frames, "A-B, counted from 1, or times as in 1.2s-1.8s",
              {.only_with = only_with});
  options.add("--textgrid", choice.textgrid,
              "Praat TextGrid: one frame a labelled interval or point, with its label",
              {.only_with = only_with});
  options.add("--tier", choice.tier, "The tier of it", {.only_with = {"--textgrid"}});
  options.add("--labels", choice.labels, "Frames with these labels alone: a,i,u",
              {.separator = ',', .only_with = only_with});
  options.add("--recording", choice.recording,
              "This one's frames alone, where the file has several", {.only_with = only_with});
}

void add_measured_options(Options& options, MeasuredOptions& o) {
  options.add("--target", o.target, "Contour file");
  options.add("--palate", o.palate,
              "Palate trace of the same session, of a scan the palate's surface");
  add_reading_options(options, o);
  options.add("--bite-plane", o.bite_plane,
              "Bite plane of the same session: a straight trace, or sensors on a plate");
  options.add("--bite-plane-sensors", o.bite_plane_sensors,
              "EMA: the sensors on the plate there, by default OS, MS and BP...",
              {.separator = ',', .only_with = {"--bite-plane"}});
  options.add("--hyoid", o.hyoid,
              "X,Y of the hyoid or its shadow, in the numbers of the target's contours");
  options.add("--short-tendon", o.short_tendon,
              "The same of the genioglossus' short tendon, where it leaves the jaw");
  options.add("--jaw-shadow", o.jaw_shadow,
              "The same of the mandible's lower edge, where its shadow begins");
  options.flag("--ignore-marks", o.ignore_marks,
               "Leave out hyoid, short tendon and mandible that the target has by name");
  options.flag("--force-registration", o.force,
               "Answer although the registration fails its test; every result says so");
  options.flag(
      "--registered", o.registered, "The file is in the model's frame already",
      {.not_with = {"--palate", "--bite-plane", "--hyoid", "--short-tendon", "--jaw-shadow"}});
  add_choice_options(options, o.choice);
  options.add("--speaker", o.choice.speaker, "This one's frames alone, where the file has several");
  options.add("--noise-mm", o.noise_mm,
              fmt::format("Measurement noise (by the format: {})", usual_noises()),
              {.positive = true});
}

}  // namespace genio::cli
