#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace genio {

struct Series {
  std::string name;
  std::vector<Eigen::Vector2d> points;
};

/// Lines with marks over a framed field, as an SVG; `logarithmic` on both axes (all values above
/// 0). `notes`: lines of small print below.
std::string plot(const std::string& title, const std::string& x_label, const std::string& y_label,
                 const std::vector<Series>& series, bool logarithmic_x, bool logarithmic_y,
                 const std::vector<std::string>& notes = {});

}  // namespace genio
