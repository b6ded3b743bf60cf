#include "inverse/contour_file.hpp"

#include <fmt/format.h>

#include "inverse/contour_formats.hpp"
#include "inverse/table_text.hpp"

namespace genio {

ContourFile read_contours(const std::string& path, const std::string& format) {
  if (format == "csv") return read_csv_contours(path);
  if (format == "aaa") return read_aaa_contours(path);
  if (format != "auto")
    throw InputError(
        fmt::format("--format {}: unknown; this version reads auto, csv and aaa", format));
  TableLines lines(path);
  std::string first;
  while (lines.next(first) && trimmed(first).empty()) {
  }
  if (first.find('\t') != std::string::npos) return read_aaa_contours(path);
  if (first.find(',') != std::string::npos) return read_csv_contours(path);
  throw InputError(
      fmt::format("{}:{}: neither tab-separated (AAA) nor comma-separated (CSV); give --format",
                  path, std::max(1, lines.number())));
}

}  // namespace genio
