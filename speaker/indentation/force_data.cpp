#include "speaker/indentation/force_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

constexpr size_t fewest_depths = 5;
constexpr size_t most_rows = 100000;
constexpr double contradiction = 8;     // standard deviations between forces at one depth
constexpr double usual_scatter = 0.05;  // of a force, where none is given
constexpr double deepest_mm = 100, shallowest_mm = 0.05, largest_force = 1000;

struct ForceRow {
  double depth_mm, force, sd;
  int line;
};

using Number = std::optional<double> ExperimentNotes::*;

const std::array<std::pair<const char*, Number>, 7> number_notes = {
    {{"radius_mm", &ExperimentNotes::radius_mm},
     {"thickness_mm", &ExperimentNotes::thickness_mm},
     {"half_width_mm", &ExperimentNotes::half_width_mm},
     {"mucosa_mm", &ExperimentNotes::mucosa_mm},
     {"poisson_ratio", &ExperimentNotes::poisson_ratio},
     {"mucosa_a10_Pa", &ExperimentNotes::mucosa_a10_Pa},
     {"mucosa_a20_Pa", &ExperimentNotes::mucosa_a20_Pa}}};

/// Takes "# key = value"; other remarks are for people.
void take_note(const std::string& line, const TablePlace& at, ExperimentNotes& notes) {
  const size_t equals = line.find('=');
  if (equals == std::string::npos) return;
  const std::string key = trimmed(line.substr(1, equals - 1)),
                    value = trimmed(line.substr(equals + 1));
  if (key.find(' ') != std::string::npos) return;
  if (key == "indenter") {
    indenter_of(value);
    notes.indenter = value;
    return;
  }
  std::vector<std::string> names = {"indenter"};
  for (const auto& [name, number] : number_notes) {
    names.emplace_back(name);
    if (key != name) continue;
    double v = 0;
    if (!parse_number(value, v) || !(v > 0))
      at.fail(fmt::format("{} = {}; expected a number above 0", name, in_quotes(value)));
    notes.*number = v;
    return;
  }
  at.fail(
      fmt::format("unknown remark {}; expected one of {}", in_quotes(key), fmt::join(names, ", ")));
}

struct ForceColumns {
  int force = -1, depth = -1, sd = -1;
  size_t count = 0;
};

ForceColumns force_columns(const std::vector<std::string>& header, const TablePlace& at) {
  ForceColumns c;
  c.count = header.size();
  for (size_t i = 0; i < header.size(); ++i) {
    const std::string name = trimmed(header[i]);
    for (auto [wanted, column] :
         {std::pair{"force_N", &c.force}, {"depth_mm", &c.depth}, {"sd", &c.sd}})
      if (name == wanted) {
        if (*column >= 0) at.fail(fmt::format("column {} stands twice", wanted));
        *column = int(i);
      }
  }
  for (const auto& [name, column] : {std::pair{"force_N", c.force}, {"depth_mm", c.depth}})
    if (column < 0)
      at.fail(fmt::format("no column {}; expected a header force_N,depth_mm[,sd]", name));
  return c;
}

double force_number(const std::vector<std::string>& fields, int column, const char* name,
                    TableNumbers& numbers, const TablePlace& at) {
  double v = 0;
  if (!numbers.parse(fields[size_t(column)], v))
    at.fail(fmt::format("{}: {}; expected a number", name, in_quotes(fields[size_t(column)])));
  return v;
}

ForceRow force_row(const std::string& line, char separator, const ForceColumns& c,
                   TableNumbers& numbers, const TablePlace& at) {
  const auto fields = fields_of(line, separator);
  if (fields.size() != c.count) at.fail(other_count(fields.size(), "the header", c.count, line));
  ForceRow r{force_number(fields, c.depth, "depth_mm", numbers, at),
             force_number(fields, c.force, "force_N", numbers, at), 0, at.number()};
  if (r.depth_mm < 0)
    at.fail(fmt::format("depth_mm: {:g}; expected 0 or more, from the first touch inwards",
                        r.depth_mm));
  if (r.depth_mm > deepest_mm)
    at.fail(fmt::format("depth_mm: {:g}; expected at most {:g} mm (are these other units?)",
                        r.depth_mm, deepest_mm));
  if (std::abs(r.force) > largest_force)
    at.fail(fmt::format("force_N: {:g}; expected at most {:g} N (are these other units?)", r.force,
                        largest_force));
  if (c.sd >= 0) {
    r.sd = force_number(fields, c.sd, "sd", numbers, at);
    if (!(r.sd > 0 && r.sd < largest_force))
      at.fail(fmt::format("sd: {:g}; expected the force's standard deviation, above 0 N", r.sd));
  }
  return r;
}

/// Depths go one way all along: else rows are mixed up, or the indenter was drawn back.
void check_order(const std::vector<ForceRow>& rows, const std::string& path) {
  double first = 0;
  for (size_t i = 1; i < rows.size(); ++i) {
    const double step = rows[i].depth_mm - rows[i - 1].depth_mm;
    if (first * step < 0)
      throw InputError(
          fmt::format("{}:{}: depth_mm {:g} comes after {:g}; expected depths that "
                      "only rise or only fall",
                      path, rows[i].line, rows[i].depth_mm, rows[i - 1].depth_mm));
    if (first == 0) first = step;
  }
}

/// Once sorted: forces at the same depth.
void check_repeats(const std::vector<ForceRow>& rows, const std::string& path) {
  double largest = 0;
  for (const ForceRow& r : rows) largest = std::max(largest, std::abs(r.force));
  for (size_t i = 1; i < rows.size(); ++i) {
    const ForceRow &a = rows[i - 1], &b = rows[i];
    if (a.depth_mm != b.depth_mm) continue;
    const double assumed = usual_scatter * std::max(std::abs(a.force), 0.05 * largest);
    const double sd = std::hypot(a.sd > 0 ? a.sd : assumed, b.sd > 0 ? b.sd : assumed);
    if (std::abs(a.force - b.force) > contradiction * sd)
      throw InputError(
          fmt::format("{}:{}: force_N {:g} at depth_mm {:g}, where line {} has {:g}; "
                      "expected forces that agree within their scatter",
                      path, b.line, b.force, b.depth_mm, a.line, a.force));
  }
}

void check_curve(const std::vector<ForceRow>& rows, const std::string& path) {
  size_t depths = 0;
  for (size_t i = 0; i < rows.size(); ++i)
    depths += rows[i].depth_mm > 0 && (i == 0 || rows[i].depth_mm != rows[i - 1].depth_mm);
  if (depths < fewest_depths)
    throw InputError(fmt::format("{}: {} different depths above 0; expected at least {}", path,
                                 depths, fewest_depths));
  if (rows.back().depth_mm < shallowest_mm)
    throw InputError(
        fmt::format("{}: the greatest depth_mm is {:g}; expected millimetres, and at "
                    "least {:g} (are these metres?)",
                    path, rows.back().depth_mm, shallowest_mm));
  double work = 0;
  for (const ForceRow& r : rows) work += r.force * r.depth_mm;
  if (!(work > 0))
    throw InputError(path +
                     ": the forces do not grow with depth; expected positive force_N where "
                     "the indenter presses");
}

}  // namespace

ForceFile read_force_file(const std::string& path) {
  TableLines lines(path);
  ForceFile file;
  std::string line = lines.first_filled();
  while (line.starts_with('#')) {
    take_note(line, lines, file.notes);
    if (!lines.next_filled(line)) lines.fail("no header; expected force_N,depth_mm[,sd]");
  }
  const char separator = separator_of(line);
  const ForceColumns columns = force_columns(fields_of(line, separator), lines);
  TableNumbers numbers(separator);
  std::vector<ForceRow> rows;
  while (lines.next_filled(line)) {
    if (line.starts_with('#')) continue;
    if (rows.size() == most_rows)
      lines.fail(fmt::format("more than {} rows; expected at most that many", most_rows));
    rows.push_back(force_row(line, separator, columns, numbers, lines));
  }
  if (rows.empty()) throw InputError(path + ": no row below the header");
  check_order(rows, path);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.depth_mm < b.depth_mm; });
  check_repeats(rows, path);
  check_curve(rows, path);
  const auto n = Eigen::Index(rows.size());
  ForceData& d = file.data;
  d.depth.resize(n), d.force.resize(n);
  if (columns.sd >= 0) d.sd = Vector(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ForceRow& r = rows[size_t(i)];
    d.depth[i] = 1e-3 * r.depth_mm, d.force[i] = r.force;
    if (d.sd) (*d.sd)[i] = r.sd;
  }
  return file;
}

ExperimentNotes merged(const ExperimentNotes& said, const ExperimentNotes& otherwise) {
  ExperimentNotes both = said;
  if (!both.indenter) both.indenter = otherwise.indenter;
  for (const auto& [name, number] : number_notes)
    if (!(both.*number)) both.*number = otherwise.*number;
  return both;
}

IndentationExperiment experiment_of(const ExperimentNotes& n, bool with_mucosa) {
  IndentationExperiment e;
  if (n.indenter) e.indenter = indenter_of(*n.indenter);
  if (n.radius_mm) e.radius = 1e-3 * *n.radius_mm;
  if (n.thickness_mm) e.thickness = 1e-3 * *n.thickness_mm;
  e.half_width = n.half_width_mm ? 1e-3 * *n.half_width_mm : 10 * e.radius;
  if (with_mucosa) e.mucosa = 1e-3 * n.mucosa_mm.value_or(1);
  if (n.poisson_ratio) e.poisson_ratio = *n.poisson_ratio;
  check(e);
  return e;
}

YeohConstants mucosa_of(const ExperimentNotes& n) {
  constexpr YeohConstants usual{384, 180};
  YeohConstants c;
  c.a10 = n.mucosa_a10_Pa.value_or(usual.a10);
  c.a20 = n.mucosa_a20_Pa.value_or(usual.a20 / usual.a10 * c.a10);
  return c;
}

}  // namespace genio
