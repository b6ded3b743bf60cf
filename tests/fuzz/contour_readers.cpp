// Recordings of all formats, and what is read beside them.

#include "forward/base/input_file.hpp"
#include "inverse/prior/prior_file.hpp"
#include "inverse/recording/contour_file.hpp"
#include "inverse/recording/format_list.hpp"
#include "inverse/recording/session/session.hpp"
#include "inverse/recording/textgrid.hpp"
#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {
namespace {

/// A file is read by the name of its format, and once more as a palate of a format to be found: of
/// these two only the first may refuse it for good.
FuzzReader contour_reader(const ContourFormat& format) {
  FuzzReader reader;
  reader.name = format.traits.name;
  reader.file = format.example.name;
  reader.seeds = {format.example.text};
  ReadOptions found = format.example.options, named = found;
  named.format = format.traits.name;
  reader.read = [found, named](const std::string& path) {
    SessionFile target;
    target.file.units = "mm";
    try {
      read_palate(path, found, target);
    } catch (const InputError&) {
    }
    read_contours(path, named);
  };
  return reader;
}

FuzzReader textgrid_reader() {
  return {
      "textgrid",
      "word.TextGrid",
      {"File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0\nxmax = 1\n"
       "tiers? <exists>\nsize = 2\nitem []:\n item [1]:\n  class = \"IntervalTier\"\n"
       "  name = \"word\"\n  xmin = 0\n  xmax = 1\n  intervals: size = 1\n"
       "  intervals [1]:\n   xmin = 0\n   xmax = 1\n   text = \"a \"\"b\"\"\"\n item [2]:\n"
       "  class = \"TextTier\"\n  name = \"point\"\n  xmin = 0\n  xmax = 1\n"
       "  points: size = 1\n  points [1]:\n   number = 0.5\n   mark = \"x\"\n",
       "\"ooTextFile\"\n\"TextGrid\"\n0\n1\n<exists>\n1\n\"IntervalTier\"\n\"w\"\n0\n1\n1\n0\n1\n"
       "\"a\"\n! end\n"},
      [](const std::string& path) {
        const auto tiers = read_textgrid(path);
        tier_named(tiers, tiers.front().name, path);
      }};
}

FuzzReader prior_reader() {
  return {"prior",
          "prior.toml",
          {"effort_sd = 0.3\nsymmetry_sd = 0.05\nemg = \"emg.csv\"\n[cocontraction]\nmean = 0.1\n"
           "sd = 0.05\n[fixed_N]\nGGP = 1.5\n[parameter.\"jaw_opening.angle\"]\nmean = 4\nsd = 1\n"
           "[head_pose]\nshift_sd_mm = 1\nturn_sd_deg = 2\n",
           "smoothness_sd = 0.2\n[emg.GGP]\nmean = 0.2\nsd = 0.05\n"},
          [](const std::string& path) { read_prior(path); },
          {{"emg.csv", "muscle,mean,sd\nGGP,0.2,0.05\n"}}};
}

/// As it comes from the network, and as it goes there.
FuzzReader sent_prior_reader() {
  return {"sent_prior",
          "sent.toml",
          {"effort_sd = 0.3\nmuscles_rest = false\n[emg]\nGGP = {mean = 0.2, sd = 0.05}\n"
           "[fixed_N]\nMH = 0\n",
           "[head_pose]\nshift_sd_mm = 1\n"},
          [](const std::string& path) {
            prior_of_text("prior", prior_text(path));
            prior_of_text("prior", read_file(path));
          }};
}

FuzzReader emg_reader() {
  return {"emg",
          "emg.csv",
          {"muscle,mean,sd\nGGP,0.2,0.05\nSTY_L,0,1e-3\n"},
          [](const std::string& path) { read_prior(path); }};
}

}  // namespace

std::vector<FuzzReader> contour_readers() {
  std::vector<FuzzReader> readers = {textgrid_reader(), prior_reader(), sent_prior_reader(),
                                     emg_reader()};
  for (const ContourFormat& format : contour_formats()) readers.push_back(contour_reader(format));
  return readers;
}

}  // namespace genio::test
