#include "speaker/slices/flat_stack.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "inverse/recording/base/table_text.hpp"
#include "speaker/slices/crossings.hpp"

namespace genio {
namespace {

constexpr double smallest = 2e-3, largest = 0.4;  // extent of a bone or an organ in a head [m]
constexpr double same_height = 1e-6;              // [m]
constexpr double flat = 5e-5;                     // [m], or more where the slices lie far apart
constexpr double flat_part = 0.1;                 // of the slices' mean distance
constexpr double least_area = 1e-10;              // [m^2]
constexpr size_t many_points = 100;

/// Half the sum of cross products: the outline's area times its normal.
Vec3 area_vector(const std::vector<Vec3>& outline) {
  Vec3 sum = Vec3::Zero();
  for (size_t i = 1; i + 1 < outline.size(); ++i)
    sum += (outline[i] - outline[0]).cross(outline[i + 1] - outline[0]);
  return sum / 2;
}

std::string slice_of(const ContourStack& stack, const StackSlice& slice) {
  return fmt::format("{}: slice {}", stack.source, in_quotes(slice.name));
}

Vec3 common_normal(const ContourStack& stack) {
  Vec3 sum = Vec3::Zero();
  for (const StackSlice& slice : stack.slices)
    for (const auto& outline : slice.outlines) {
      const Vec3 area = area_vector(outline);
      if (area.norm() < least_area)
        throw InputError(slice_of(stack, slice) +
                         ": an outline has no area; expected a closed outline");
      sum += sum.dot(area) < 0 ? Vec3(-area) : area;
    }
  return sum.normalized();
}

void check_units(const ContourStack& stack) {
  Eigen::AlignedBox3d box;
  size_t points = 0;
  std::array<bool, 3> whole = {true, true, true};
  for (const StackSlice& slice : stack.slices)
    for (const auto& outline : slice.outlines)
      for (const Vec3& p : outline) {
        box.extend(p);
        ++points;
        for (int d = 0; d < 3; ++d)
          if (std::abs(p[d] * 1e3 - std::round(p[d] * 1e3)) > 1e-9) whole[size_t(d)] = false;
      }
  const double extent = box.sizes().maxCoeff();
  if (extent < smallest)
    throw InputError(
        fmt::format("{}: the outlines span {:.3g} mm in all; expected millimetres, "
                    "not metres",
                    stack.source, extent * 1e3));
  if (extent > largest)
    throw InputError(
        fmt::format("{}: the outlines span {:.3g} mm; expected millimetres of a head, "
                    "not pixels",
                    stack.source, extent * 1e3));
  if (points >= many_points && whole[0] + whole[1] + whole[2] >= 2) {
    int varied = 0;
    for (int d = 0; d < 3; ++d) varied += whole[size_t(d)] && box.sizes()[d] > smallest;
    if (varied >= 2)
      throw InputError(
          fmt::format("{}: all of {} points lie at whole numbers; expected "
                      "millimetres, not pixels",
                      stack.source, points));
  }
}

}  // namespace

FlatStack flat_stack(const ContourStack& stack) {
  check_units(stack);
  FlatStack result;
  result.source = stack.source;
  Vec3 w = common_normal(stack);
  for (int d = 0; d < 3; ++d)  // an axis of the file, but for rounding
    if (std::abs(w[d]) > 1 - 1e-8) w = w[d] < 0 ? Vec3(-Vec3::Unit(d)) : Vec3(Vec3::Unit(d));
  const auto mean_height = [&](const StackSlice& slice) {
    double sum = 0, count = 0;
    for (const auto& outline : slice.outlines)
      for (const Vec3& p : outline) sum += p.dot(w), ++count;
    return sum / count;
  };
  if (mean_height(stack.slices.back()) < mean_height(stack.slices.front())) w = -w;
  const Vec3 u = (std::abs(w[0]) < 0.8 ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY()));
  result.axes.col(2) = w;
  result.axes.col(0) = (u - u.dot(w) * w).normalized();
  result.axes.col(1) = w.cross(result.axes.col(0));
  const double mean_gap = (mean_height(stack.slices.back()) - mean_height(stack.slices.front())) /
                          double(stack.slices.size() - 1);
  for (const StackSlice& slice : stack.slices) {
    FlatStack::Slice made{mean_height(slice), {}, slice.name};
    for (const auto& outline : slice.outlines) {
      FlatOutline drawn;
      for (const Vec3& p : outline) {
        const Vec3 uvw = result.axes.transpose() * p;
        const double off = std::abs(uvw[2] - made.height);
        if (off > std::max(flat, flat_part * mean_gap))
          throw InputError(
              fmt::format("{}: a point lies {:.2f} mm off the slice's plane; expected "
                          "flat, parallel slices",
                          slice_of(stack, slice), off * 1e3));
        drawn.emplace_back(uvw[0], uvw[1]);
      }
      made.outlines.push_back(std::move(drawn));
    }
    if (!result.slices.empty()) {
      const auto& before = result.slices.back();
      const double gap = made.height - before.height;
      if (std::abs(gap) < same_height)
        throw InputError(
            fmt::format("{}: lies at the height of slice {}; expected each height "
                        "once",
                        slice_of(stack, slice), in_quotes(before.name)));
      if (gap < 0)
        throw InputError(
            fmt::format("{}: lies back behind slice {}; expected slices in the order "
                        "of their heights",
                        slice_of(stack, slice), in_quotes(before.name)));
    }
    if (const std::string fault = crossing_fault(made.outlines); !fault.empty())
      throw InputError(slice_of(stack, slice) + ": " + fault);
    result.slices.push_back(std::move(made));
  }
  return result;
}

}  // namespace genio
