#include "inverse/recording/base/confidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr double good_residual = 15;  // of AG50x, which gives 3 to 15 for sensors that work

}  // namespace

double widening_by_likelihood(double p) { return 1 / std::sqrt(p); }

double widening_by_confidence(double confidence, double usual) {
  return confidence < usual ? std::sqrt(usual / confidence) : 1;
}

double widening_by_residual(double rms) {
  return std::isfinite(rms) ? std::max(1.0, std::abs(rms) / good_residual) : 1;
}

void remark_widened(ContourFile& file) {
  size_t all = 0, wider = 0;
  double most = 1;
  for (const ContourFrame& frame : file.frames)
    for (const ContourPoint& p : frame.points) {
      ++all, wider += p.widening > 1;
      most = std::max(most, p.widening);
    }
  if (wider > 0)
    file.remarks.push_back(
        fmt::format("{} of {} points count less, by what the file says of them: their noise is up "
                    "to {:.2f} times the others'",
                    wider, all, most));
}

}  // namespace genio
