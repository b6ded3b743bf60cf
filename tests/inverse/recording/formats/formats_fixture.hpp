#pragma once
// A contour to be written in some format and read again.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "inverse/recording/contour_file.hpp"
#include "inverse/target/tongue_line.hpp"

namespace genio {

class Formats : public testing::Test {
 protected:
  Formats() {
    for (int k = 0; k < 30; ++k) {  // tip first, an arch 70 mm long
      const double s = k / 29.0;
      line.emplace_back(55 + 70 * s, 95 + 25 * std::sin(3 * s));
    }
  }
  ~Formats() override { std::filesystem::remove_all(folder); }

  std::string write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  }
  /// The line as two frames, the second 1 mm up.
  void expect_line(const ContourFile& f, double tolerance = 0.01) {
    ASSERT_EQ(f.frames.size(), 2u);
    for (size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(f.frames[k].points.size(), line.size());
      for (size_t i = 0; i < line.size(); ++i) {
        EXPECT_NEAR(1e3 * f.frames[k].points[i].position[0], line[i][0], tolerance);
        EXPECT_NEAR(1e3 * f.frames[k].points[i].position[2], line[i][1] + double(k), tolerance);
      }
    }
  }
  std::string error(const std::string& path, const ReadOptions& o = {}) {
    try {
      read_contours(path, o);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  static bool says(const ContourFile& f, const std::string& what) {
    for (const auto& r : f.remarks)
      if (r.find(what) != std::string::npos) return true;
    return false;
  }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("genio_formats_{}", getpid());
  std::vector<Vec2> line;  // [mm], model axes
};

}  // namespace genio
