#include "inverse/recording/curves/aaa_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "forward/base/median.hpp"
#include "inverse/recording/base/confidence.hpp"
#include "inverse/recording/base/named_curve.hpp"
#include "inverse/recording/curves/aaa_row.hpp"

namespace genio {
namespace {

constexpr double low_confidence = 0.5;  // of the most there can be
constexpr double most_points = 10000;

enum class Part { single, count, radii, angles, pairs, xs, ys, confidences, other };

/// What one title stands for: a single column, or one for each point of a spline.
struct Block {
  Part part = Part::single;
  std::string spline;
};

int columns_a_point(Part part) {
  return part == Part::single || part == Part::count ? 0 : part == Part::pairs ? 2 : 1;
}

/// `R mm values of spline "Tongue"` taken apart. A block without a name is the last one's.
Block block_of(const std::string& field, const std::string& last) {
  const std::string title = trimmed(field), lower = lower_case(title);
  const auto of = lower.find("of spline"), values = lower.find("values");
  const std::string spline =
      of == std::string::npos ? last : trimmed(title.substr(of + std::string("of spline").size()));
  if (lower.starts_with("number of points of spline")) return {Part::count, spline};
  if (values == std::string::npos || (of != std::string::npos && values > of)) return {};
  if (of == std::string::npos && (last.empty() || values + 6 != lower.size())) return {};
  const std::string what = lower.substr(0, lower.find(' '));
  for (const auto& [word, part] :
       {std::pair{"r", Part::radii}, std::pair{"angle", Part::angles},
        std::pair{"confidence", Part::confidences}, std::pair{"x,y", Part::pairs},
        std::pair{"xy", Part::pairs}, std::pair{"x", Part::xs}, std::pair{"y", Part::ys}})
    if (what == word) return {part, spline};
  return of == std::string::npos ? Block{} : Block{Part::other, spline};
}

struct Layout {
  std::vector<Block> blocks;
  AaaColumns before;
  std::string spline;                // the one to read
  std::vector<std::string> heads;    // those that show points of the head
  std::map<std::string, bool> told;  // by name of a spline: whether rows tell its number of points
  int singles = 0, a_point = 0;      // columns, and columns a point of splines that do not tell it
};

Layout layout_of(const std::vector<std::string>& titles, const ReadOptions& o,
                 const TableLines& lines) {
  Layout l;
  l.before = aaa_columns(titles);
  std::vector<std::string> splines;
  std::string last;
  for (const std::string& title : titles) {
    const Block& block = l.blocks.emplace_back(block_of(title, last));
    if (block.part == Part::single) continue;
    last = block.spline;
    if (l.told.try_emplace(last, false).second) splines.push_back(last);
    if (block.part == Part::count) l.told[last] = true;
  }
  int untold = 0;
  for (const auto& [name, told] : l.told) untold += !told;
  if (untold > 0 && splines.size() > 1)
    lines.fail(
        "several splines, of which not all tell their number of points: export 'Number of points "
        "of spline' with each, or the tongue's alone");
  for (const Block& block : l.blocks)
    if (const int n = columns_a_point(block.part); n == 0) ++l.singles;
    else l.a_point += n;
  l.spline = named_curve(splines, o, fmt::format("{}:{}", lines.path(), lines.number()));
  for (const std::string& name : splines)
    if (o.role == "tongue" && name != l.spline && !head_points_in(name).empty())
      l.heads.push_back(name);
  return l;
}

/// Values of the blocks of a spline; empty where it has no such block.
struct Values {
  std::map<Part, std::vector<std::string>> of;
  bool has(Part part) const { return of.contains(part); }
  std::string at(Part part, size_t k) const { return of.at(part)[k]; }
  size_t count() const {
    return has(Part::radii)   ? of.at(Part::radii).size()
           : has(Part::pairs) ? of.at(Part::pairs).size() / 2
                              : of.at(Part::xs).size();
  }
};

size_t whole_count(const std::string& field, size_t column, const TableLines& lines) {
  double n = 0;
  if (!parse_number(field, n) || n != std::floor(n) || n < 0 || n > most_points)
    lines.fail(fmt::format("field {}: {}; expected the number of points of the spline", column + 1,
                           in_quotes(field)));
  return size_t(n);
}

/// The number of points that makes the row as long as it is, where no column tells it.
size_t untold_count(const std::vector<std::string>& fields, const Layout& l,
                    const TableLines& lines) {
  auto rest = long(fields.size()) - l.singles;
  if (rest % l.a_point == 1 && trimmed(fields.back()).empty()) --rest;
  if (rest < 0 || rest % l.a_point != 0)
    lines.fail(
        fmt::format("{} fields; expected {} and a multiple of {}. Is there a tab in the prompt?",
                    fields.size(), l.singles, l.a_point));
  return size_t(rest / l.a_point);
}

/// Of all splines, by their names.
std::map<std::string, Values> values_of(const std::vector<std::string>& fields, const Layout& l,
                                        const TableLines& lines) {
  std::map<std::string, Values> values;
  std::map<std::string, size_t> counts;
  for (const auto& [name, told] : l.told)
    if (!told) counts[name] = untold_count(fields, l, lines);
  size_t at = 0;
  for (const Block& block : l.blocks) {
    const bool single = columns_a_point(block.part) == 0;
    if (!single && !counts.contains(block.spline))
      lines.fail(fmt::format("the number of points of spline {} stands behind its values",
                             in_quotes(block.spline)));
    const size_t width = single ? 1 : size_t(columns_a_point(block.part)) * counts.at(block.spline);
    if (at + width > fields.size())
      lines.fail(fmt::format("{} fields; its titles and numbers of points need {} or more",
                             fields.size(), at + width));
    if (block.part == Part::count) counts[block.spline] = whole_count(fields[at], at, lines);
    if (!single)
      values[block.spline].of[block.part].assign(fields.begin() + long(at),
                                                 fields.begin() + long(at + width));
    at += width;
  }
  if (fields.size() > at + 1 || (fields.size() == at + 1 && !trimmed(fields.back()).empty()))
    lines.fail(
        fmt::format("{} fields; its titles and numbers of points need {}. Is there a tab in the "
                    "prompt?",
                    fields.size(), at));
  return values;
}

std::vector<AaaKnot> knots_of(const Values& v, TableNumbers& numbers, const TableLines& lines) {
  const bool polar = v.has(Part::radii), pairs = v.has(Part::pairs);
  if (polar ? !v.has(Part::angles) : !pairs && !(v.has(Part::xs) && v.has(Part::ys)))
    lines.fail("the spline has neither radii and angles nor X and Y");
  std::vector<AaaKnot> knots;
  for (size_t k = 0; k < v.count(); ++k) {
    const std::string a = polar   ? v.at(Part::radii, k)
                          : pairs ? v.at(Part::pairs, 2 * k)
                                  : v.at(Part::xs, k);
    const std::string b = polar   ? v.at(Part::angles, k)
                          : pairs ? v.at(Part::pairs, 2 * k + 1)
                                  : v.at(Part::ys, k);
    if (is_missing(a) && is_missing(b)) continue;
    AaaKnot knot;
    knot.place = k;
    for (const auto& [text, value] : {std::pair{&a, &knot.x}, std::pair{&b, &knot.y}})
      if (!numbers.parse(*text, *value))
        lines.fail(fmt::format("knot {}: {}; expected {}, or '*'", k, numbers.complaint(*text),
                               polar ? "a radius and an angle" : "X and Y"));
    if (polar) {
      if (std::abs(knot.y) > 2 * std::numbers::pi)
        lines.fail(fmt::format("knot {}: angle {}; expected radians", k, knot.y));
      const double radius = knot.x, angle = knot.y;
      knot.x = radius * std::sin(angle), knot.y = radius * std::cos(angle);
    }
    if (v.has(Part::confidences) && !is_missing(v.at(Part::confidences, k))) {
      double confidence = 0;
      const std::string text = v.at(Part::confidences, k);
      if (!numbers.parse(text, confidence) || confidence < 0 || confidence > 100)
        lines.fail(fmt::format("knot {}: confidence {}; expected 0 to 100", k, in_quotes(text)));
      knot.confidence = confidence;
    }
    knots.push_back(knot);
  }
  return knots;
}

/// A spline of a row that shows points of the head.
struct HeadSpline {
  std::string name;
  std::vector<AaaKnot> knots;
  size_t count = 0;  ///< missing ones counted
};

/// The least confidence that counts. Programs give 0 to 100, and some 0 to 1.
double least_confidence(const std::vector<std::vector<AaaKnot>>& rows) {
  double most = 0;
  for (const auto& row : rows)
    for (const AaaKnot& knot : row) most = std::max(most, knot.confidence.value_or(0));
  return low_confidence * (most > 1 ? 100 : 1);
}

/// Knots that the tracker trusts less than usual count less.
void widen(std::vector<std::vector<AaaKnot>>& rows, double least) {
  std::vector<double> seen;
  for (const auto& row : rows)
    for (const AaaKnot& knot : row)
      if (knot.confidence && *knot.confidence >= least) seen.push_back(*knot.confidence);
  if (seen.empty()) return;
  const double usual = median(std::move(seen));
  for (auto& row : rows)
    for (AaaKnot& knot : row)
      if (knot.confidence && *knot.confidence >= least)
        knot.widening = widening_by_confidence(*knot.confidence, usual);
}

}  // namespace

RawContours read_aaa_blocks(const std::string& path, const ReadOptions& o) {
  TableLines lines(path);
  RawContours raw{{}, FileAxes{"mm", "right", "up"}};
  auto& frames = raw.file.frames;
  raw.file.model_frame = false;
  std::string line = lines.first_filled();
  const Layout l = layout_of(split_fields(line, '\t'), o, lines);
  TableNumbers numbers('\t');
  std::vector<std::vector<AaaKnot>> rows;
  std::vector<std::vector<HeadSpline>> heads;
  while (lines.next_filled(line)) {
    const auto fields = split_fields(line, '\t');
    auto values = values_of(fields, l, lines);
    frames.push_back(aaa_frame(int(frames.size()) + 1, l.before, fields, numbers, lines));
    rows.push_back(knots_of(values[l.spline], numbers, lines));
    auto& of_row = heads.emplace_back();
    for (const std::string& spline : l.heads)
      of_row.push_back({spline, knots_of(values[spline], numbers, lines), values[spline].count()});
  }
  if (frames.empty()) lines.fail("the file has no data row");
  const double least = least_confidence(rows);
  widen(rows, least);
  AaaLosses losses;
  for (size_t k = 0; k < frames.size(); ++k) {
    AaaHeadPoints head;
    for (const HeadSpline& s : heads[k]) head.add(s.name, s.knots, s.count, least);
    head.add_to(raw.file.head_points);
    add_knots(frames[k], rows[k], least, o.role == "tongue", losses);
  }
  remark_losses(raw.file, losses, least);
  if (numbers.has_commas()) raw.file.remarks.push_back("numbers have decimal commas");
  return raw;
}

bool names_aaa_blocks(const std::string& header) {
  const std::string lower = lower_case(header);
  return lower.find("number of points of spline") != std::string::npos ||
         lower.find("values of spline") != std::string::npos;
}

bool has_aaa_blocks(const std::string& path) {
  TableLines lines(path);
  std::string first;
  return lines.next_filled(first) && names_aaa_blocks(first);
}

}  // namespace genio
