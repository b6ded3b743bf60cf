#include "inverse/recording/curves/deeplabcut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inverse/recording/binary/pandas_file.hpp"
#include "inverse/recording/curves/body_parts.hpp"

namespace genio {
namespace {

bool begins_with(const std::vector<std::string>& fields, const std::string& title) {
  return lower_case(trimmed(fields.front())) == title;
}

void refuse_several(const std::vector<std::string>& individuals, const TablePlace& place) {
  for (const std::string& one : individuals)
    if (!trimmed(one).empty() && trimmed(one) != trimmed(individuals.back()))
      place.fail(fmt::format("several individuals, {} and {}; expected one speaker a file",
                             in_quotes(one), in_quotes(individuals.back())));
}

/// Of the columns behind the first, which is the index.
std::vector<BodyPartTitle> titles_of(TableLines& lines, char separator) {
  std::string line;
  std::vector<std::string> bodies, coords;
  while (coords.empty()) {
    if (!lines.next_filled(line)) lines.fail("has no row 'coords' of its header");
    const auto fields = fields_of(line, separator);
    if (begins_with(fields, "bodyparts")) bodies = fields;
    else if (begins_with(fields, "coords")) coords = fields;
    else if (begins_with(fields, "individuals"))
      refuse_several({fields.begin() + 1, fields.end()}, lines);
    else if (!begins_with(fields, "scorer"))
      lines.fail("expected the header rows scorer, bodyparts and coords");
  }
  if (bodies.size() != coords.size())
    lines.fail(fmt::format("{} fields; the row 'bodyparts' has {}", coords.size(), bodies.size()));
  std::vector<BodyPartTitle> titles;
  for (size_t c = 1; c < coords.size(); ++c)
    titles.push_back({trimmed(bodies[c]), lower_case(trimmed(coords[c]))});
  return titles;
}

RawContours read_csv(const std::string& path, const ReadOptions& o) {
  std::string line = TableLines(path).first_filled();
  const char separator = separator_of(line);
  TableLines lines(path);
  const auto titles = titles_of(lines, separator);
  BodyPartTable table(titles, o, lines);
  TableNumbers numbers(separator);
  while (lines.next_filled(line)) {
    const auto fields = fields_of(line, separator);
    if (fields.size() != titles.size() + 1)
      lines.fail(other_count(fields.size(), "header", titles.size() + 1, line));
    table.add_row(trimmed(fields[0]), [&](size_t column) {
      double value = std::nan("");
      const std::string& field = fields[column + 1];
      if (!is_missing(field) && !numbers.parse(field, value))
        lines.fail(fmt::format("field {}, {}: {}", column + 2, in_quotes(titles[column].part),
                               numbers.complaint(field)));
      return value;
    });
  }
  return table.contours();
}

/// The place of a row in a table that has no lines.
struct RowPlace : TablePlace {
  using TablePlace::TablePlace;
  void next() { ++number_; }
};

RawContours read_hdf5(const std::string& path, const ReadOptions& o) {
  const PandasTable read = read_pandas_file(path);
  RowPlace place(path);
  std::vector<BodyPartTitle> titles;
  std::vector<std::string> individuals;
  for (const auto& levels : read.titles) {
    if (levels.size() != 3 && levels.size() != 4)
      place.fail(
          fmt::format("{} levels of titles; expected scorer, bodyparts and coords", levels.size()));
    titles.push_back({levels[levels.size() - 2], lower_case(levels.back())});
    if (levels.size() == 4) individuals.push_back(levels[1]);
  }
  refuse_several(individuals, place);
  BodyPartTable table(titles, o, place);
  for (size_t r = 0; r < read.rows.size(); ++r) {
    place.next();
    table.add_row(read.index[r], [&](size_t column) { return read.rows[r][column]; });
  }
  return table.contours();
}

bool is_hdf5(const FileStart& start) { return start.ending == ".h5" && start.bytes == "\x89HDF"; }

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
          .about = "DeepLabCut's CSV with its three header rows, or its .h5",
          .known_by_bytes = is_hdf5,
          .known_by_line = known_by_line,
          .read =
              [](const std::string& path, const ReadOptions& o) {
                return path.ends_with(".h5") ? read_hdf5(path, o) : read_csv(path, o);
              },
          .example = {.name = "video.csv",
                      .text = "scorer,DLC,DLC,DLC,DLC,DLC,DLC,DLC,DLC,DLC\n"
                              "bodyparts,tongueRoot,tongueRoot,tongueRoot,tongueBody,tongueBody,"
                              "tongueBody,tongueTip,tongueTip,tongueTip\n"
                              "coords,x,y,likelihood,x,y,likelihood,x,y,likelihood\n"
                              "0,110,170,0.98,150,95,0.97,250,120,0.91\n",
                      .options = pixels}};
}

}  // namespace genio
