#pragma once
// Bodies of known shape, and files that hold them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include "speaker/isosurface/isosurface.hpp"
#include "speaker/slices/contour_stack.hpp"

namespace genio::test {

/// A folder for one test.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "genio-speaker-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be made");
    path_ = name;
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

/// What an action complains of; empty where it does not.
inline std::string complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// A round outline of radius r(angle) about (x, y), all in mm, at height z mm.
inline std::vector<Vec3> round_outline_at(double x, double y, double z, int points,
                                          const std::function<double(double)>& r) {
  std::vector<Vec3> outline;
  for (int i = 0; i < points; ++i) {
    const double a = 2 * std::numbers::pi * i / points;
    outline.emplace_back(1e-3 * (x + r(a) * std::cos(a)), 1e-3 * (y + r(a) * std::sin(a)),
                         1e-3 * z);
  }
  return outline;
}

inline std::vector<Vec3> circle(double x, double y, double z, double r, int points = 40) {
  return round_outline_at(x, y, z, points, [r](double) { return r; });
}

/// A stack of one outline a slice.
inline ContourStack stack_of(const std::vector<std::vector<Vec3>>& outlines) {
  ContourStack stack{{}, "test"};
  for (size_t i = 0; i < outlines.size(); ++i)
    stack.slices.push_back({std::to_string(i + 1), {outlines[i]}});
  return stack;
}

/// The surface of a body within a box, by its signed distance or something like it [m].
inline TriangleSurface body(const Vec3& low, const Vec3& high, double step,
                            const std::function<double(const Vec3&)>& value) {
  LayeredField field;
  for (int d = 0; d < 3; ++d)
    for (double at = low[d]; at < high[d] + step; at += step) field.axis[size_t(d)].push_back(at);
  field.layer = [&](int k, std::span<float> values) {
    size_t i = 0;
    for (const double y : field.axis[1])
      for (const double x : field.axis[0])
        values[i++] = float(value({x, y, field.axis[2][size_t(k)]}));
  };
  return isosurface(field, [](const Vec3& p) { return p; });
}

inline TriangleSurface ball(double radius, double step) {
  const Vec3 corner = Vec3::Constant(radius + 2.3 * step);
  return body(-corner, corner, step, [&](const Vec3& p) { return p.norm() - radius; });
}

/// A horseshoe with two branches that rise at its ends, an alveolar ridge, and a spine inside the
/// chin: about what a lower jaw is, 100 mm long. In the model's frame; step of its grid [m].
TriangleSurface jaw_like(double step);

/// The chin's inside, where the tongue's muscles are fastened [m].
inline const Vec3 jaw_spine = {8e-3, 0, 0};

}  // namespace genio::test
