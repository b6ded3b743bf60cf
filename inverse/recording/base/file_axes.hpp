#pragma once
// From a file's units and axes to metres with x backwards and z up.

#include <limits>
#include <optional>
#include <string>

#include "inverse/recording/base/contours.hpp"

namespace genio {

/// A coordinate that the file does not give, as that across a midsagittal plane.
inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// Metres a unit of length ("mm", "cm", "m" or "um"); none for others.
std::optional<double> metres_a_unit(const std::string& unit);

/// What a format says of its axes; empty where it says nothing.
struct FileAxes {
  std::string units, facing, up;
};

/// The file in metres, its axes as they are. The caller decides on the units, else the format, else
/// the extent of its frames. Throws InputError naming `path` where nothing says it.
ContourFile in_metres(ContourFile file, const FileAxes& axes, const std::string& path,
                      const ReadOptions& options);

/// Throws InputError for a facing or a direction that there is not.
void check_axes_options(const ReadOptions& options);

/// The file, whose positions are (along, across, up) in its own units and directions, in metres
/// with x backwards and z up. The caller decides, else the format, else the points themselves; the
/// remarks say who did. Throws InputError naming `path` where nothing says it.
ContourFile in_model_axes(ContourFile file, const FileAxes& axes, const std::string& path,
                          const ReadOptions& options);

/// Adds to the remarks which way the points of its curves run.
void remark_order(ContourFile& file);
/// "tip to root" or "root to tip", as most of its curves run; empty where it holds none.
std::string points_order(const ContourFile& file);

/// The same file with x turned around.
ContourFile mirrored(ContourFile file);

}  // namespace genio
