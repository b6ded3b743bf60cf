#include "inverse/recording/base/curve_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/base/median.hpp"

namespace genio {
namespace {

constexpr double least_jump = 15e-3;  // [m]
constexpr double times_spacing = 8;
constexpr size_t stray = 3;          // points in a row that may be none of the curve
constexpr size_t most_pieces = 100;  // each is compared with each
constexpr double beside = 0.6;       // share of a piece that lies along the other

using Piece = std::vector<ContourPoint>;

double gap(const ContourPoint& a, const ContourPoint& b) {
  return std::hypot(a.position[0] - b.position[0], a.position[2] - b.position[2]);
}

std::vector<Piece> pieces_of(const std::vector<ContourPoint>& points) {
  std::vector<double> gaps;
  for (size_t k = 1; k < points.size(); ++k) gaps.push_back(gap(points[k - 1], points[k]));
  const double jump = std::max(least_jump, times_spacing * median(gaps));
  std::vector<Piece> pieces(1, {points.front()});
  for (size_t k = 1; k < points.size(); ++k) {
    if (gaps[k - 1] > jump) pieces.emplace_back();
    pieces.back().push_back(points[k]);
  }
  return pieces;
}

/// True where most of `b` lies in the stretch along the head that `a` takes.
bool retraces(const Piece& a, const Piece& b) {
  const auto along = [](const ContourPoint& p, const ContourPoint& q) {
    return p.position[0] < q.position[0];
  };
  const auto ends = std::minmax_element(a.begin(), a.end(), along);
  const double first = ends.first->position[0], last = ends.second->position[0];
  const auto inside = std::count_if(b.begin(), b.end(), [&](const ContourPoint& p) {
    return p.position[0] >= first && p.position[0] <= last;
  });
  return double(inside) > beside * double(b.size());
}

/// How many points of a frame are left out.
size_t keep_the_curve(ContourFrame& frame, const std::string& path) {
  auto& points = frame.points;
  const bool curve = std::all_of(points.begin(), points.end(),
                                 [](const ContourPoint& p) { return p.kind == "curve"; });
  if (!curve || points.size() < 6) return 0;
  std::vector<Piece> pieces = pieces_of(points);
  std::vector<Piece> kept;
  for (Piece& piece : pieces)
    if (piece.size() > stray) kept.push_back(std::move(piece));
  if (kept.size() > most_pieces)
    throw InputError(fmt::format(
        "{}: frame {}: its points lie in {} pieces far from each other; expected one curve a frame",
        path, frame.number, kept.size()));
  for (size_t a = 0; a < kept.size(); ++a)
    for (size_t b = 0; b < a; ++b)
      if (retraces(kept[a], kept[b]) || retraces(kept[b], kept[a]))
        throw InputError(fmt::format(
            "{}: frame {}: its points go on for {} and start again beside them, {} mm away: two "
            "takes in one frame? Expected one curve a frame",
            path, frame.number, kept[b].size(),
            std::lround(1e3 * gap(kept[b].back(), kept[a].front()))));
  const size_t before = points.size();
  points.clear();
  for (Piece& piece : kept) points.insert(points.end(), piece.begin(), piece.end());
  return before - points.size();
}

}  // namespace

ContourFile with_one_curve_a_frame(ContourFile file, const std::string& path) {
  size_t out = 0, frames = 0;
  int first = 0;
  for (ContourFrame& frame : file.frames)
    if (const size_t here = keep_the_curve(frame, path)) {
      if (out == 0) first = frame.number;
      out += here, ++frames;
      frame.note += fmt::format("{}{} points far from their neighbours left out",
                                frame.note.empty() ? "" : "; ", here);
    }
  if (out > 0)
    file.remarks.push_back(fmt::format(
        "points far from their neighbours are left out: {} in {} frames, the first in frame {}",
        out, frames, first));
  return file;
}

}  // namespace genio
