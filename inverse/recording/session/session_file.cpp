#include "inverse/recording/session/session_file.hpp"

#include "inverse/recording/base/curve_pieces.hpp"

namespace genio {
namespace {

SessionFile read_trace(const std::string& path, ReadOptions options, const SessionFile& target) {
  check_axes_options(options);
  RawContours raw = read_raw(path, options);
  if (raw.axes && raw.axes->units.empty() && options.units.empty() && options.mm_per_px == 0)
    options.units = target.file.units;
  return session_file(path, std::move(raw), options);
}

}  // namespace

SessionFile session_file(const std::string& path, RawContours raw, const ReadOptions& options) {
  const FileAxes axes = raw.axes.value_or(FileAxes{"m", "left", "up"});
  ContourFile file =
      raw.axes ? in_metres(std::move(raw.file), axes, path, options) : std::move(raw.file);
  return {path, with_one_curve_a_frame(std::move(file), path), axes};
}

SessionFile read_session_file(const std::string& path, const ReadOptions& options) {
  check_axes_options(options);
  return session_file(path, read_raw(path, options), options);
}

SessionFile read_palate(const std::string& path, ReadOptions options, const SessionFile& target) {
  options.role = "palate";
  return read_trace(path, std::move(options), target);
}

SessionFile read_bite_plane(const std::string& path, ReadOptions options,
                            const SessionFile& target) {
  options.role = "bite plane";
  return read_trace(path, std::move(options), target);
}

}  // namespace genio
