#pragma once
// Measured shapes in files.

#include <map>
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// One point, in metres and x backwards, z up; in the device's own frame until registered.
struct ContourPoint {
  Vec3 position;             ///< [m]; y NaN where not given
  double sigma = 0;          ///< [m]; 0: the caller's noise
  std::string kind;          ///< "curve", "surface", "volume" or a flesh point's name
  Vec3 rest = Vec3::Zero();  ///< of a volume point: where its tissue lies at rest [m]
  int slice = 0;             ///< of a surface point: which contour it belongs to
};

/// One shape: a frame of a recording.
struct ContourFrame {
  int number = 0;     ///< data row or sample from 1, or the file's own frame number
  std::string label;  ///< prompt, word or label, where given
  double time_s = 0;
  std::string note;  ///< why it has no points, if it has none
  std::vector<ContourPoint> points;
};

enum class ContourFormat { csv, aaa, getcontours, edgetrak, ema, surface };

const char* to_string(ContourFormat format);

/// What no file says, or what the caller knows better.
struct ReadOptions {
  std::string format = "auto";  ///< auto, csv, aaa, getcontours, edgetrak, ema, surface
  std::string units;            ///< mm, cm, m, um, px; empty: the format's, or by the extent
  double mm_per_px = 0;
  std::string facing;  ///< left (x grows backwards) or right; empty: the format's, or unknown
  std::string up;      ///< up or down: where y grows to; empty: the format's, or by the arch
  /// Sensor of a flesh-point recording, by number or name, to what it is stuck to: "tip", ...
  std::map<std::string, std::string> sensors;
  double rate_hz = 0;  ///< of samples, where the file does not tell
};

struct ContourFile {
  ContourFormat format = ContourFormat::csv;
  bool model_frame = true;  ///< false: needs registration (the device's own axes)
  /// False where neither file nor caller tells which way the face looks: the palate has to.
  bool facing_known = true;
  std::vector<std::string> remarks;  ///< units, facing, point order: what was taken for granted
  std::vector<ContourFrame> frames;
};

/// Reads CSV (`frame,point,x_mm,[y_mm,]z_mm[,sigma_mm][,kind][,label][,time_s]
/// [,rest_x_mm,rest_y_mm,rest_z_mm][,slice]`, model frame), AAA tab-separated exports (Cartesian
/// and polar), GetContours tables (long, wide, _EdgeTrak), EdgeTrak .con and other plain tables of
/// x, y columns, EMA (AG500 and AG501 .pos, AG501 text, SSFF), and surfaces (PLY, OBJ, STL). Throws
/// InputError naming file, line and field.
ContourFile read_contours(const std::string& path, const ReadOptions& options = {});

/// Adds to the remarks which way the points of its curves run.
void remark_order(ContourFile& file);

/// The same file with x turned around.
ContourFile mirrored(ContourFile file);

}  // namespace genio
