#pragma once
// Measured shapes, as readers hand them on.

#include <map>
#include <string>
#include <vector>

#include "forward/base/types.hpp"
#include "inverse/recording/base/head_points.hpp"

namespace genio {

/// One point, in metres and x backwards, z up; in the device's own frame until registered.
struct ContourPoint {
  Vec3 position;             ///< [m]; y NaN where not given
  double sigma = 0;          ///< [m]; 0: the caller's noise
  std::string kind;          ///< "curve", "surface", "volume" or a flesh point's name
  Vec3 rest = Vec3::Zero();  ///< of a volume point: where its tissue lies at rest [m]
  int slice = 0;             ///< of a surface point: which contour it belongs to
  double widening = 1;       ///< of the caller's noise, where the file is less sure of the point
};

/// One shape: a frame of a recording.
struct ContourFrame {
  int number = 0;     ///< data row or sample from 1, or the file's own frame number
  std::string label;  ///< prompt, word or label, where given
  double time_s = 0;
  std::string recording, speaker;  ///< which take, and whose, where given
  std::string note;                ///< why it has no points, or which were left out
  std::vector<ContourPoint> points;
  bool registered = false;  ///< it is another speaker's, laid beside the model

  void add_note(const std::string& text) { note += (note.empty() ? "" : "; ") + text; }
};

/// What one assumes when nobody says [m]: of points that come from anywhere, of ultrasound.
constexpr double point_noise = 0.5e-3, ultrasound_noise = 1.5e-3;

/// What the frames of a format hold: contours, positions of sensors, or points of a surface.
enum class Content { curves, sensors, surface };

/// What holds for every file of a format.
struct FormatTraits {
  std::string name;  ///< as --format names it
  Content content = Content::curves;
  double noise = point_noise;  ///< what one assumes when nobody says [m]
  /// Which way the face looks is a habit of the program's users, and no file says it.
  bool facing_by_habit = false;
};

/// What no file says, or what the caller knows better.
struct ReadOptions {
  std::string format = "auto";  ///< a name of contour_formats(), or auto
  std::string units;            ///< mm, cm, m, um, px; empty: the format's, or by the extent
  double mm_per_px = 0;
  std::string facing;  ///< left (x grows backwards) or right; empty: the format's, or unknown
  std::string up;      ///< up or down: where y grows to; empty: the format's, or by the arch
  std::string axes;    ///< of sensors: which run back and up, as in -x+z; empty: found
  /// Sensor of a flesh-point recording, by number or name, to what it is stuck to: "tip", ...
  std::map<std::string, std::string> sensors;
  /// Columns of a table that no format knows: "x", "y", "frame", "time", "label", "likelihood",
  /// "recording", "speaker" to the column's title, or its number from 1.
  std::map<std::string, std::string> columns;
  /// The spline to take where a file has several; empty: the only one that is named for the tongue.
  std::string spline;
  /// What the file is to show: "tongue", "palate" or "bite plane". Of several splines, that one is
  /// taken.
  std::string role = "tongue";
  std::string points;  ///< "A-B": those of a list of landmarks that are the tongue's
  double rate_hz = 0;  ///< of samples, where the file does not tell
};

struct ContourFile {
  FormatTraits format;
  bool model_frame = true;  ///< false: needs registration (the device's own axes)
  /// False where neither file nor caller tells which way the face looks: the palate has to.
  bool facing_known = true;
  std::string units;                 ///< of the file's numbers
  std::vector<std::string> remarks;  ///< units, facing, point order: what was taken for granted
  std::vector<ContourFrame> frames;
  /// Beside the tongue, in the file's own numbers and directions whatever the frames are in.
  HeadPointTracks head_points = {};
};

}  // namespace genio
