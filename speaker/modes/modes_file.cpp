#include "speaker/modes/modes_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "speaker/solid/table_columns.hpp"

namespace genio {
namespace {

constexpr double file_mm = 1e-3;
constexpr const char* minor_mode = "minor";
const std::vector<std::string> first_columns = {"stretch", "point",      "x_mm",
                                                "z_mm",    "apart_x_mm", "apart_z_mm"};

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (char c : line)
    if (c == ',') fields.emplace_back();
    else fields.back() += c;
  return fields;
}

[[noreturn]] void fail_at(const std::string& path, int row, const std::string& what) {
  throw InputError(fmt::format("{}: line {}: {}", path, row, what));
}

double number_at(const std::string& path, int row, const std::string& column,
                 const std::string& field) {
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  if (field.empty() || *end != '\0' || !std::isfinite(value))
    fail_at(path, row, fmt::format("column {}: {}; expected a number", column, in_quotes(field)));
  return value;
}

/// The modes' names by the header's columns.
std::vector<std::string> modes_in(const std::vector<std::string>& header, const std::string& path,
                                  int row) {
  for (size_t k = 0; k < first_columns.size(); ++k)
    if (k >= header.size() || header[k] != first_columns[k])
      fail_at(path, row,
              fmt::format("expected the column {} as number {}", first_columns[k], k + 1));
  std::vector<std::string> names;
  for (size_t k = first_columns.size(); k + 1 < header.size(); k += 2) {
    const std::string name = header[k].substr(0, header[k].rfind("_x_mm"));
    if (header[k] != name + "_x_mm" || header[k + 1] != name + "_z_mm")
      fail_at(path, row,
              fmt::format("column {}: expected MODE_x_mm and MODE_z_mm in pairs",
                          in_quotes(header[k])));
    names.push_back(name);
  }
  if (names.empty()) fail_at(path, row, "expected the columns of a mode or more");
  return names;
}

}  // namespace

OutlineModes read_outline_modes(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path + ": no such file of outline modes");
  OutlineModes modes;
  std::string line;
  std::vector<std::string> names;
  int row = 0;
  size_t stretch = 0;
  int point = 0;
  while (std::getline(in, line)) {
    ++row;
    if (line.empty()) continue;
    if (line[0] == '#') {
      std::sscanf(line.c_str(), "# kept %lf, speakers %d", &modes.kept, &modes.speakers);
      continue;
    }
    const auto fields = fields_of(line);
    if (names.empty()) {
      names = modes_in(fields, path, row);
      modes.mean.resize(2 * outline_point_count()), modes.apart.resize(modes.mean.size());
      modes.modes.resize(modes.mean.size(), Eigen::Index(names.size()));
      continue;
    }
    if (stretch == outline_stretches().size()) fail_at(path, row, "a point too many");
    const OutlineStretch& s = outline_stretches()[stretch];
    if (fields.size() != first_columns.size() + 2 * names.size())
      fail_at(path, row,
              fmt::format("{} fields; expected {}", fields.size(),
                          first_columns.size() + 2 * names.size()));
    if (fields[0] != s.name || fields[1] != std::to_string(point))
      fail_at(path, row, fmt::format("expected point {} of {}", point, s.name));
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Index at = 2 * (s.first + point) + axis;
      const auto value = [&](size_t column, const std::string& name) {
        return file_mm * number_at(path, row, name, fields[column]);
      };
      modes.mean[at] = value(size_t(2 + axis), first_columns[size_t(2 + axis)]);
      modes.apart[at] = value(size_t(4 + axis), first_columns[size_t(4 + axis)]);
      for (size_t k = 0; k < names.size(); ++k)
        modes.modes(at, Eigen::Index(k)) = value(6 + 2 * k + size_t(axis), names[k]);
    }
    if (++point == s.count) ++stretch, point = 0;
  }
  if (names.empty() || stretch < outline_stretches().size())
    throw InputError(
        fmt::format("{}: it ends early; expected {} points", path, outline_point_count()));
  if (!(modes.kept >= 0 && modes.kept <= 1) || modes.speakers < 2)
    throw InputError(path + ": expected a first line \"# kept K, speakers N\"");
  for (const std::string& name : names)
    if (!name.starts_with(minor_mode)) modes.names.push_back(name);
  return modes;
}

void write_outline_modes(const OutlineModes& modes, const std::string& origin,
                         const std::string& path) {
  std::ofstream out(path);
  out << fmt::format("# kept {:.6f}, speakers {}\n# {}\n", modes.kept, modes.speakers, origin);
  std::string header;
  for (const std::string& column : first_columns) header += (header.empty() ? "" : ",") + column;
  for (Eigen::Index k = 0; k < modes.modes.cols(); ++k) {
    const std::string name = k < modes.named() ? modes.names[size_t(k)]
                                               : minor_mode + std::to_string(k - modes.named() + 1);
    header += fmt::format(",{0}_x_mm,{0}_z_mm", name);
  }
  out << header << "\n";
  for (const OutlineStretch& s : outline_stretches())
    for (int i = 0; i < s.count; ++i) {
      const Eigen::Index at = 2 * (s.first + i);
      out << fmt::format("{},{},{:.3f},{:.3f},{:.3f},{:.3f}", s.name, i, modes.mean[at] / file_mm,
                         modes.mean[at + 1] / file_mm, modes.apart[at] / file_mm,
                         modes.apart[at + 1] / file_mm);
      for (Eigen::Index k = 0; k < modes.modes.cols(); ++k)
        out << fmt::format(",{:.4f},{:.4f}", modes.modes(at, k) / file_mm,
                           modes.modes(at + 1, k) / file_mm);
      out << "\n";
    }
  out.flush();
  if (!out) throw InputError(path + ": cannot be written");
}

}  // namespace genio
