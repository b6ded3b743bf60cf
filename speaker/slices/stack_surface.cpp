#include "speaker/slices/stack_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "speaker/isosurface/isosurface.hpp"
#include "speaker/slices/drift.hpp"
#include "speaker/slices/limited_spline.hpp"
#include "speaker/slices/round_outline.hpp"

namespace genio {
namespace {

constexpr double usual_nodes = 4e5, most_nodes = 2e8;
constexpr double finest = 1e-4, coarsest = 0.8e-3;  // usual steps [m]

/// A stack as values on layers of a grid that drifts along with the slices.
class StackField {
 public:
  StackField(const FlatStack& stack, double step) : stack_(stack), drift_(slice_drift(stack)) {
    Eigen::AlignedBox2d box;
    for (size_t s = 0; s < stack.slices.size(); ++s)
      for (const auto& outline : stack.slices[s].outlines)
        for (const auto& p : outline) box.extend(Eigen::Vector2d(p - drift_[s]));
    const double bottom = stack.slices.front().height, top = stack.slices.back().height;
    if (step == 0)
      step = std::clamp(std::cbrt(box.volume() * (top - bottom) / usual_nodes), finest, coarsest);
    step_ = step;
    const double nodes = (box.sizes()[0] / step + 5) * (box.sizes()[1] / step + 5) *
                         ((top - bottom) / step + double(stack.slices.size()));
    if (nodes > most_nodes)
      throw InputError(
          fmt::format("{}: a step of {:.3g} mm makes {:.2g} nodes; expected at most "
                      "{:.0e}: take a larger --step",
                      stack.source, step * 1e3, nodes, most_nodes));
    for (int d = 0; d < 2; ++d)
      for (double at = box.min()[d] - 2 * step; at < box.max()[d] + 3 * step; at += step)
        field_.axis[size_t(d)].push_back(at);
    for (size_t s = 0; s + 1 < stack.slices.size(); ++s) {
      const double from = stack.slices[s].height, gap = stack.slices[s + 1].height - from;
      const int layers = std::max(1, int(std::ceil(gap / step - 1e-6)));
      for (int k = 0; k < layers; ++k) {
        field_.axis[2].push_back(from + gap * k / layers);
        between_.push_back(s);
      }
    }
    field_.axis[2].push_back(top);
    between_.push_back(stack.slices.size() - 2);
    field_.layer = [this](int k, std::span<float> values) { fill(k, values); };
  }
  StackField(const StackField&) = delete;

  const LayeredField& field() const { return field_; }
  double step() const { return step_; }

  /// Where a place of the drifting grid lies [m].
  Vec3 place(const Vec3& uvw) const {
    const auto& heights = field_.axis[2];
    const auto above = std::upper_bound(heights.begin(), heights.end(), uvw[2]);
    const size_t layer = above == heights.begin() ? 0 : size_t(above - heights.begin()) - 1;
    const size_t s = between_[layer];
    const double t = std::clamp(fraction(s, uvw[2]), 0.0, 1.0);
    const auto drift = [&](int d) {
      return limited_spline(
          heights_about(s),
          {drift_[before(s)][d], drift_[s][d], drift_[s + 1][d], drift_[behind(s)][d]}, t);
    };
    return stack_.place(uvw + Vec3(drift(0), drift(1), 0));
  }

 private:
  size_t before(size_t s) const { return s > 0 ? s - 1 : 0; }
  size_t behind(size_t s) const { return std::min(s + 2, stack_.slices.size() - 1); }
  double fraction(size_t s, double height) const {
    const double from = stack_.slices[s].height;
    return (height - from) / (stack_.slices[s + 1].height - from);
  }
  FourHeights heights_about(size_t s) const {
    const auto h = [&](size_t i) { return stack_.slices[i].height; };
    return {{h(before(s)), h(s), h(s + 1), h(behind(s))}, s == 0, s + 2 == stack_.slices.size()};
  }

  const std::vector<float>& slice_values(size_t s) {
    auto& values = values_[s];
    if (!values.empty()) return values;
    std::vector<FlatOutline> outlines;
    for (const auto& outline : stack_.slices[s].outlines)
      outlines.push_back(round_outline(outline, step_ / 2));
    const SliceDistance distance(outlines);
    const auto &u = field_.axis[0], &v = field_.axis[1];
    std::vector<double> along = u;
    for (double& at : along) at += drift_[s][0];
    values.resize(u.size() * v.size());
    for (size_t j = 0; j < v.size(); ++j)
      distance.row(along, v[j] + drift_[s][1], &values[j * u.size()]);
    return values;
  }

  void fill(int k, std::span<float> out) {
    const size_t s = between_[size_t(k)];
    values_.erase(values_.begin(), values_.lower_bound(before(s)));
    const auto &a = slice_values(before(s)), &b = slice_values(s), &c = slice_values(s + 1),
               &d = slice_values(behind(s));
    const FourHeights heights = heights_about(s);
    const double t = fraction(s, field_.axis[2][size_t(k)]);
    for (size_t i = 0; i < out.size(); ++i)
      out[i] = float(limited_spline(heights, {a[i], b[i], c[i], d[i]}, t));
  }

  const FlatStack& stack_;
  std::vector<Eigen::Vector2d> drift_;
  double step_;
  LayeredField field_;
  std::vector<size_t> between_;  ///< by layer, the slice at it or below it
  std::map<size_t, std::vector<float>> values_;
};

}  // namespace

StackedSurface stack_surface(const ContourStack& stack, double step) {
  const FlatStack flat = flat_stack(stack);
  StackField field(flat, step);
  const auto place = [&](const Vec3& uvw) { return field.place(uvw); };
  StackedSurface result{isosurface(field.field(), place), field.step()};
  if (result.surface.triangles.empty())
    throw InputError(
        fmt::format("{}: the outlines hold no node of a grid of {:.3g} mm; expected a "
                    "smaller --step",
                    stack.source, field.step() * 1e3));
  return result;
}

}  // namespace genio
