#include "speaker/outline/outline.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>

#include "speaker/solid/table_columns.hpp"

namespace genio {
namespace {

constexpr size_t most_outline_points = 100000;
constexpr double same_outline_place = 1e-7;  // [m]

/// Where the columns stand; past the end of the header where there is none.
struct OutlineColumns {
  size_t segment, point, speaker, x, up, lateral, none;
  double unit;  ///< [m]
  std::string x_name, up_name;
};

OutlineColumns outline_columns(const std::vector<std::string>& header, const TablePlace& place,
                               bool segment_needed) {
  OutlineColumns c{};
  c.none = header.size();
  c.segment = column_named(header, "segment"), c.point = column_named(header, "point");
  c.speaker = column_named(header, "speaker");
  if ((segment_needed && c.segment == c.none) || c.point == c.none)
    place.fail(fmt::format("no column {}; expected segment, point, x_cm and y_cm or x_mm and y_mm",
                           c.point == c.none ? "point" : "segment"));
  for (const auto& [unit, metres] : {std::pair{"cm", 1e-2}, {"mm", 1e-3}}) {
    const std::string ending = std::string("_") + unit;
    c.x = column_named(header, "x" + ending);
    if (c.x == c.none) continue;
    const size_t y = column_named(header, "y" + ending), z = column_named(header, "z" + ending);
    c.up = z == c.none ? y : z;
    c.lateral = z == c.none ? c.none : y;
    c.unit = metres, c.x_name = "x" + ending, c.up_name = (z == c.none ? "y" : "z") + ending;
    if (c.up == c.none) place.fail(fmt::format("no column y{0} or z{0} beside x{0}", ending));
    return c;
  }
  place.fail("no column x_cm or x_mm; expected centimetres or millimetres in the columns' names");
}

std::optional<Segment> segment_of(const std::string& name) {
  for (const auto& [begins, segment] : {std::pair{"tongue", Segment::tongue},
                                        {"upper_incisor_palate", Segment::palate},
                                        {"palate", Segment::palate},
                                        {"mandible", Segment::mandible},
                                        {"hyoid", Segment::hyoid},
                                        {"pharynx", Segment::pharynx},
                                        {"epiglottis", Segment::epiglottis}})
    if (name.starts_with(begins)) return segment;
  return std::nullopt;
}

/// A table's rows as lines by name, each with its points in turn.
class OutlineRows {
 public:
  OutlineRows(const std::string& path, const std::string& speaker, bool segment_needed)
      : lines_(path), wanted_(speaker) {
    std::string line = lines_.first_filled();
    const char separator = separator_of(line);
    const auto header = fields_of(line, separator);
    columns_ = outline_columns(header, lines_, segment_needed);
    TableNumbers numbers(separator);
    while (lines_.next_filled(line)) {
      const auto fields = fields_of(line, separator);
      if (fields.size() != header.size())
        lines_.fail(other_count(fields.size(), "the header", header.size(), line));
      add(fields, numbers);
    }
    if (!wanted_.empty() && by_name_.empty())
      throw InputError(fmt::format("{}: no speaker {}; expected {}", path, in_quotes(wanted_),
                                   listed_speakers()));
  }

  std::map<std::string, std::vector<Vec2>> by_name() const { return by_name_; }
  const std::vector<std::string>& speakers() const { return in_order_; }
  std::string listed_speakers() const {
    if (speakers_.empty()) return "no --speaker, as the file has no column speaker";
    std::string list;
    for (const std::string& s : in_order_) list += (list.empty() ? "" : ", ") + s;
    return "one of " + list;
  }

 private:
  void add(const std::vector<std::string>& fields, TableNumbers& numbers) {
    const OutlineColumns& c = columns_;
    if (c.speaker != c.none) {
      const std::string speaker = trimmed(fields[c.speaker]);
      if (speakers_.insert(speaker).second) in_order_.push_back(speaker);
      if (!wanted_.empty() && speaker != wanted_) return;
      if (wanted_.empty() && speakers_.size() > 1) return;  // an error, once all are known
    } else if (!wanted_.empty()) {
      return;
    }
    const auto number = [&](size_t at, const std::string& name) {
      return number_of_column(name, fields[at], numbers, lines_);
    };
    const std::string name =
        c.segment == c.none ? "palate" : lower_case(trimmed(fields[c.segment]));
    if (name.empty()) lines_.fail("column segment: is empty; expected a name such as tongue");
    const double point = number(c.point, "point");
    const auto last = last_.find(name);
    if (last != last_.end() && point <= last->second)
      lines_.fail(fmt::format("segment {}: point {:g} follows point {:g}; expected rising numbers",
                              name, point, last->second));
    last_[name] = point;
    if (c.lateral != c.none && std::abs(number(c.lateral, "y")) * c.unit > 5e-3)
      lines_.fail(
          fmt::format("segment {}, point {:g}: lies {:g} mm beside the midsagittal plane; "
                      "expected y of 0, as z is up",
                      name, point, number(c.lateral, "y") * c.unit * 1e3));
    const Vec2 place(c.unit * number(c.x, c.x_name), c.unit * number(c.up, c.up_name));
    if (!(place.cwiseAbs().maxCoeff() < 10))
      lines_.fail(
          fmt::format("segment {}, point {:g}: is out of all range; wrong units?", name, point));
    std::vector<Vec2>& points = by_name_[name];
    if (points.size() >= most_outline_points)
      lines_.fail(fmt::format("segment {}: expected at most {} points", name, most_outline_points));
    if (points.empty() || (points.back() - place).norm() > same_outline_place)
      points.push_back(place);
  }

  TableLines lines_;
  std::string wanted_;
  OutlineColumns columns_{};
  std::map<std::string, std::vector<Vec2>> by_name_;
  std::map<std::string, double> last_;
  std::set<std::string> speakers_;
  std::vector<std::string> in_order_;
};

}  // namespace

std::string segment_name(Segment segment) {
  switch (segment) {
    case Segment::tongue:
      return "tongue";
    case Segment::palate:
      return "palate";
    case Segment::mandible:
      return "mandible";
    case Segment::hyoid:
      return "hyoid";
    case Segment::pharynx:
      return "pharynx";
    case Segment::epiglottis:
      break;
  }
  return "epiglottis";
}

std::string SpeakerOutline::name() const {
  return speaker.empty() ? source : fmt::format("{}, speaker {}", source, speaker);
}

SpeakerOutline read_outline(const std::string& path, const std::string& speaker) {
  const OutlineRows rows(path, speaker, true);
  if (speaker.empty() && rows.speakers().size() > 1)
    throw InputError(fmt::format("{}: {} speakers; choose with --speaker {}", path,
                                 rows.speakers().size(), rows.listed_speakers()));
  SpeakerOutline outline{path, speaker, {}, false, false, {}};
  if (speaker.empty() && rows.speakers().size() == 1) outline.speaker = rows.speakers().front();
  std::map<Segment, std::string> seen;
  for (auto& [name, points] : rows.by_name()) {
    const auto segment = segment_of(name);
    if (!segment || points.size() < 2) continue;
    if (const auto other = seen.find(*segment); other != seen.end())
      throw InputError(fmt::format("{}: segments {} and {} are both a {}; expected one",
                                   outline.name(), other->second, name, segment_name(*segment)));
    seen[*segment] = name;
    outline.segments[*segment] = points;
    if (name.starts_with("tongue_surface") || name.starts_with("tongue_free"))
      outline.free_surface_only = true;
  }
  if (!outline.has(Segment::tongue))
    throw InputError(
        fmt::format("{}: no segment tongue; expected one of two points or more", outline.name()));
  return outline;
}

std::vector<std::string> outline_speakers(const std::string& path) {
  return OutlineRows(path, "", true).speakers();
}

void read_outline_palate(const std::string& path, SpeakerOutline& outline) {
  OutlineRows rows(path, "", false);
  if (rows.speakers().size() > 1) rows = OutlineRows(path, outline.speaker, false);
  for (auto& [name, points] : rows.by_name())
    if (segment_of(name) == Segment::palate && points.size() > 1) {
      outline.segments[Segment::palate] = points;
      return;
    }
  throw InputError(fmt::format("{}: no segment palate of two points or more", path));
}

std::vector<std::vector<Vec2>> read_outline_lines(const std::string& path) {
  const OutlineRows rows(path, "", false);
  std::vector<std::vector<Vec2>> lines;
  for (const auto& [name, points] : rows.by_name())
    if (points.size() > 1) lines.push_back(points);
  if (lines.empty()) throw InputError(fmt::format("{}: no line of two points or more", path));
  return lines;
}

}  // namespace genio
