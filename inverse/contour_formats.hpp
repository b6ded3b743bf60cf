#pragma once
#include "inverse/contour_file.hpp"

namespace genio {

/// One function a format; read_contours chooses.
ContourFile read_csv_contours(const std::string& path);
ContourFile read_aaa_contours(const std::string& path);

}  // namespace genio
