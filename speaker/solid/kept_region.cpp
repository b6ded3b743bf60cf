#include "speaker/solid/kept_region.hpp"

#include <fmt/format.h>

#include <array>

#include "speaker/solid/table_columns.hpp"

namespace genio {
namespace {

constexpr size_t most_balls = 10000;
constexpr double mm = 1e-3;  // [m]

/// The numbers of a text that holds nothing but numbers between commas; else none.
std::vector<double> only_numbers(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& field : split_fields(text, ',')) {
    double value = 0;
    if (!parse_number(trimmed(field), value)) return {};
    numbers.push_back(value);
  }
  return numbers;
}

void add_ball(KeptRegion& region, const double* xyzr, const std::string& where) {
  if (xyzr[3] <= 0) throw InputError(where + ": expected a radius above 0 mm");
  region.balls.push_back({mm * Vec3(xyzr[0], xyzr[1], xyzr[2]), mm * xyzr[3]});
}

void read_balls(KeptRegion& region, const std::string& path) {
  TableLines lines(path);
  std::string line = lines.first_filled();
  const char separator = separator_of(line);
  constexpr std::array<const char*, 4> names = {"x_mm", "y_mm", "z_mm", "radius_mm"};
  std::array<size_t, 4> column{};
  const auto header = fields_of(line, separator);
  for (size_t k = 0; k < 4; ++k) {
    column[k] = column_named(header, names[k]);
    if (column[k] == header.size())
      lines.fail(fmt::format("no column {}; expected x_mm, y_mm, z_mm and radius_mm", names[k]));
  }
  TableNumbers numbers(separator);
  while (lines.next_filled(line)) {
    const auto fields = fields_of(line, separator);
    if (fields.size() != header.size())
      lines.fail(other_count(fields.size(), "the header", header.size(), line));
    std::array<double, 4> xyzr{};
    for (size_t k = 0; k < 4; ++k)
      xyzr[k] = number_of_column(names[k], fields[column[k]], numbers, lines);
    if (region.balls.size() >= most_balls)
      lines.fail(fmt::format("expected at most {} places to keep", most_balls));
    add_ball(region, xyzr.data(), fmt::format("{}:{}", path, lines.number()));
  }
}

}  // namespace

bool KeptRegion::reaches(const Vec3& p, double radius) const {
  for (const Ball& ball : balls)
    if ((p - ball.centre).norm() <= ball.radius + radius) return true;
  for (const auto& box : boxes)
    if (box.exteriorDistance(p) <= radius) return true;
  return false;
}

KeptRegion read_kept_region(const std::vector<std::string>& texts) {
  KeptRegion region;
  for (const std::string& text : texts) {
    const auto n = only_numbers(text);
    const std::string where = "--keep " + text;
    if (n.empty()) {
      read_balls(region, text);
    } else if (n.size() == 4) {
      add_ball(region, n.data(), where);
    } else if (n.size() == 6) {
      const Vec3 a(n[0], n[1], n[2]), b(n[3], n[4], n[5]);
      region.boxes.emplace_back(mm * a.cwiseMin(b), mm * a.cwiseMax(b));
    } else {
      throw InputError(where + ": expected X,Y,Z,R or X,Y,Z,X,Y,Z in millimetres, or a file");
    }
  }
  return region;
}

}  // namespace genio
