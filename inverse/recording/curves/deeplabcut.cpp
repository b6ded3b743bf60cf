#include "inverse/recording/curves/deeplabcut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "inverse/recording/base/frame_rows.hpp"
#include "inverse/recording/base/named_curve.hpp"

namespace genio {
namespace {

constexpr double least_likelihood = 0.6;  // as DeepLabCut draws its points

/// Where one body part stands.
struct BodyPart {
  std::string name;
  size_t x = 0, y = 0;
  std::optional<size_t> likelihood;
};

struct Layout {
  size_t columns = 0;
  std::vector<BodyPart> parts;  // in the file's order
};

bool begins_with(const std::vector<std::string>& fields, const std::string& title) {
  return lower_case(trimmed(fields.front())) == title;
}

Layout layout_of(TableLines& lines, char separator) {
  std::string line;
  std::vector<std::string> bodies, coords;
  while (coords.empty()) {
    if (!lines.next_filled(line)) lines.fail("has no row 'coords' of its header");
    const auto fields = fields_of(line, separator);
    if (begins_with(fields, "bodyparts")) bodies = fields;
    else if (begins_with(fields, "coords")) coords = fields;
    else if (begins_with(fields, "individuals")) {
      for (const std::string& f : fields)
        if (!trimmed(f).empty() && trimmed(f) != trimmed(fields.back()) && &f != &fields.front())
          lines.fail(fmt::format("several individuals, {} and {}; expected one speaker a file",
                                 in_quotes(f), in_quotes(fields.back())));
    } else if (!begins_with(fields, "scorer")) {
      lines.fail("expected the header rows scorer, bodyparts and coords");
    }
  }
  if (bodies.size() != coords.size())
    lines.fail(fmt::format("{} fields; the row 'bodyparts' has {}", coords.size(), bodies.size()));
  Layout l{coords.size(), {}};
  for (size_t c = 1; c < coords.size(); ++c) {
    const std::string what = lower_case(trimmed(coords[c])), name = trimmed(bodies[c]);
    const bool same = !l.parts.empty() && l.parts.back().name == name;
    if (what == "x") l.parts.push_back({name, c, 0, {}});
    else if (what == "y" && same) l.parts.back().y = c;
    else if (what == "likelihood" && same) l.parts.back().likelihood = c;
    else if (!what.empty())
      lines.fail(fmt::format("field {}: {}; expected x, y or likelihood of one body part", c + 1,
                             in_quotes(what)));
  }
  std::set<std::string> names;
  for (const BodyPart& part : l.parts) {
    if (part.y == 0) lines.fail(fmt::format("body part {} has no y", in_quotes(part.name)));
    if (!names.insert(part.name).second)
      lines.fail(fmt::format("body part {} stands twice", in_quotes(part.name)));
  }
  return l;
}

/// True of what a part of a tongue may be called where none is called the tongue's.
bool is_tongue_like(const std::string& name) {
  for (const char* word : {"tip", "blade", "dorsum", "body", "root"})
    if (lower_case(name).find(word) != std::string::npos) return true;
  return false;
}

std::vector<BodyPart> chosen(const Layout& l, const ReadOptions& o, const TableLines& lines) {
  std::vector<BodyPart> result;
  const auto keep = [&](const auto& fits) {
    std::copy_if(l.parts.begin(), l.parts.end(), std::back_inserter(result), fits);
  };
  if (!o.spline.empty()) {
    keep([&](const BodyPart& part) {
      return lower_case(part.name).find(lower_case(o.spline)) != std::string::npos;
    });
  } else {
    keep([&](const BodyPart& part) { return is_called_for(part.name, o.role); });
    if (result.empty() && o.role == "tongue" &&
        std::all_of(l.parts.begin(), l.parts.end(),
                    [](const BodyPart& part) { return is_tongue_like(part.name); }))
      result = l.parts;
  }
  if (!result.empty()) return result;
  std::string list;
  for (size_t k = 0; k < l.parts.size() && k < 40; ++k)
    list += (k == 0 ? "" : ", ") + in_quotes(l.parts[k].name);
  lines.fail(
      fmt::format("no body part is named for the {}; it has {}; say which with --spline "
                  "TEXT, a text that their names hold",
                  o.spline.empty() ? o.role : in_quotes(o.spline), list));
}

/// The number of a row's frame, and what it is called where that is no number.
class Numbering {
 public:
  RowFrame of(const std::string& index, const TableLines& lines, double rate_hz) {
    double n = 0;
    ++rows_;
    if (!parse_number(index, n)) {
      const auto slash = index.find_last_of("/\\");
      return {rows_, "", "", slash == std::string::npos ? index : index.substr(slash + 1), {}};
    }
    if (n != std::floor(n) || n < 0 || n > 1e9)
      lines.fail(fmt::format("field 1: {} is no number of a frame", in_quotes(index)));
    if (rows_ == 1) from_zero_ = n == 0;
    RowFrame row{int(n) + (from_zero_ ? 1 : 0), "", "", "", {}};
    if (rate_hz > 0) row.time_s = n / rate_hz;
    return row;
  }
  bool from_zero() const { return from_zero_; }

 private:
  int rows_ = 0;
  bool from_zero_ = false;
};

RawContours read(const std::string& path, const ReadOptions& o) {
  if (path.ends_with(".h5"))
    throw InputError(path +
                     ": DeepLabCut's HDF5 is not read; give the CSV beside it "
                     "(analyze_videos with save_as_csv=True)");
  TableLines first(path);
  std::string line;
  if (!first.next_filled(line)) first.fail("the file is empty");
  const char separator = separator_of(line);
  TableLines lines(path);
  const Layout l = layout_of(lines, separator);
  const auto parts = chosen(l, o, lines);
  RawContours raw{{}, FileAxes{"px", "", "down"}};
  raw.file.model_frame = false;
  TableNumbers numbers(separator);
  FrameRows frames(lines);
  Numbering numbering;
  size_t all = 0, unsure = 0;
  while (lines.next_filled(line)) {
    const auto fields = fields_of(line, separator);
    if (fields.size() != l.columns)
      lines.fail(fmt::format("{} fields; the header has {}", fields.size(), l.columns));
    ContourFrame& frame = frames.frame(numbering.of(trimmed(fields[0]), lines, o.rate_hz));
    frames.count("row", 1);
    size_t dropped = 0;
    for (const BodyPart& part : parts) {
      const auto number = [&](size_t column) {
        double value = 0;
        if (!numbers.parse(fields[column], value))
          lines.fail(fmt::format("field {}, {}: {}", column + 1, in_quotes(part.name),
                                 numbers.complaint(fields[column])));
        return value;
      };
      if (is_missing(fields[part.x]) && is_missing(fields[part.y])) continue;
      const double x = number(part.x), y = number(part.y);
      ++all;
      if (part.likelihood) {
        const double p = is_missing(fields[*part.likelihood]) ? 0 : number(*part.likelihood);
        if (p < 0 || p > 1)
          lines.fail(
              fmt::format("field {}: likelihood {:g}; expected 0 to 1", *part.likelihood + 1, p));
        if (p < least_likelihood) {
          ++dropped;
          continue;
        }
      }
      frame.points.push_back({{x, not_given, y}, 0, "curve"});
    }
    unsure += dropped;
    if (dropped > 0) frame.note = fmt::format("{} points of low likelihood left out", dropped);
    else if (frame.points.empty()) frame.note = "the frame is empty (no body part has a value)";
  }
  if (frames.empty()) lines.fail("the file has a header but no row");
  raw.file.frames = frames.take();
  auto& remarks = raw.file.remarks;
  std::string left;
  for (const BodyPart& part : l.parts)
    if (std::none_of(parts.begin(), parts.end(), [&](const auto& p) { return p.x == part.x; }))
      left += (left.empty() ? "" : ", ") + part.name;
  remarks.push_back(fmt::format("{} of {} body parts are the {}'s{}{}", parts.size(),
                                l.parts.size(), o.role, left.empty() ? "" : "; left out: ", left));
  if (unsure > 0)
    remarks.push_back(fmt::format("{} of {} points left out: their likelihood is below {:g}",
                                  unsure, all, least_likelihood));
  if (numbering.from_zero())
    remarks.push_back("the file counts frames from 0; they are counted from 1 here");
  return raw;
}

bool known_by_bytes(const FileStart& start) {
  return start.ending == ".h5" && start.bytes == "\x89HDF";
}

bool known_by_line(const FileStart& start) {
  return lower_case(start.line).starts_with("scorer") && !start.more.empty() &&
         (lower_case(start.more[0]).starts_with("bodyparts") ||
          lower_case(start.more[0]).starts_with("individuals"));
}

}  // namespace

ContourFormat deeplabcut_format() {
  ReadOptions pixels;
  pixels.mm_per_px = 0.3;
  return {.traits = {.name = "deeplabcut", .noise = ultrasound_noise},
          .about = "DeepLabCut's CSV with its three header rows",
          .known_by_bytes = known_by_bytes,
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "video.csv",
                      .text = "scorer,DLC,DLC,DLC,DLC,DLC,DLC,DLC,DLC,DLC\n"
                              "bodyparts,tongueRoot,tongueRoot,tongueRoot,tongueBody,tongueBody,"
                              "tongueBody,tongueTip,tongueTip,tongueTip\n"
                              "coords,x,y,likelihood,x,y,likelihood,x,y,likelihood\n"
                              "0,110,170,0.98,150,95,0.97,250,120,0.91\n",
                      .options = pixels}};
}

}  // namespace genio
