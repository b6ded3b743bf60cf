#pragma once
// Measured shapes in files.

#include <string>
#include <vector>

#include "forward/types.hpp"

namespace genio {

/// One point as the file gives it, in metres and in the file's own axes until registered.
struct ContourPoint {
  Vec3 position;             ///< [m]; y NaN where not given
  double sigma = 0;          ///< [m]; 0: the caller's noise
  std::string kind;          ///< "curve", "surface", "volume" or a flesh point's name
  Vec3 rest = Vec3::Zero();  ///< of a volume point: where its tissue lies at rest [m]
};

/// One shape: a frame of a recording.
struct ContourFrame {
  int number = 0;     ///< data row (AAA) or value of the frame column (CSV)
  std::string label;  ///< prompt, word or label, where given
  double time_s = 0;
  std::string note;  ///< why it has no points, if it has none
  std::vector<ContourPoint> points;
};

enum class ContourFormat { csv, aaa };

struct ContourFile {
  ContourFormat format = ContourFormat::csv;
  bool model_frame = true;  ///< false: needs registration (the device's own axes)
  std::vector<ContourFrame> frames;
};

/// Reads CSV (`frame,point,x_mm,[y_mm,]z_mm[,sigma_mm][,kind][,label][,time_s]
/// [,rest_x_mm,rest_y_mm,rest_z_mm]`, model frame) or
/// AAA tab-separated exports (fan splines; +x anterior there, turned to +x backwards here).
/// `format` is "auto", "csv" or "aaa". Throws InputError naming file, line and field.
ContourFile read_contours(const std::string& path, const std::string& format = "auto");

}  // namespace genio
