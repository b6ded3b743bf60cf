#include "inverse/recording/contour_file.hpp"

#include "inverse/recording/format_list.hpp"

namespace genio {

RawContours read_raw(const std::string& path, const ReadOptions& options) {
  const ContourFormat& format =
      options.format == "auto" ? format_of(path, options) : format_named(options.format);
  RawContours raw = format.read(path, options);
  raw.file.format = format.traits;
  return raw;
}

ContourFile read_contours(const std::string& path, const ReadOptions& options) {
  RawContours raw = read_raw(path, options);
  if (!raw.axes) return std::move(raw.file);
  return in_model_axes(std::move(raw.file), *raw.axes, path, options);
}

}  // namespace genio
