#pragma once
#include "inverse/recording/contour_file.hpp"

namespace genio {

/// What a format says of its axes; empty where it says nothing.
struct FileAxes {
  std::string units, facing, up;
};

/// A file as written: positions (along, across, up) in its own units and directions.
struct RawContours {
  ContourFile file;
  FileAxes axes;
};

/// One function a format; read_contours chooses.
ContourFile read_csv_contours(const std::string& path);
RawContours read_aaa_contours(const std::string& path);
RawContours read_aaa_polar(const std::string& path);
RawContours read_getcontours(const std::string& path);
RawContours read_edgetrak(const std::string& path);
RawContours read_ema(const std::string& path, const ReadOptions& options);
RawContours read_ssff(const std::string& path, const ReadOptions& options);
RawContours read_scan(const std::string& path);

/// Samples of a flesh-point recording, one Vec3 a sensor and sample (not finite: missing), as
/// frames of the sensors that the options name. Throws InputError that lists the sensors where none
/// is named.
struct SensorTable {
  std::vector<std::string> names;
  std::vector<std::vector<Vec3>> samples;
  double rate_hz = 0;
};
RawContours sensor_frames(const std::string& path, const SensorTable& table,
                          const ReadOptions& options);

/// In metres with x backwards and z up, by what the caller, the format, or the points themselves
/// say; says so in the remarks. Throws InputError naming `path` where nothing says it.
ContourFile in_model_axes(RawContours raw, const std::string& path, const ReadOptions& options);

}  // namespace genio
