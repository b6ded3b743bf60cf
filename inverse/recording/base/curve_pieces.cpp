#include "inverse/recording/base/curve_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/base/median.hpp"

namespace genio {
namespace {

constexpr double least_jump = 15e-3;  // [m]
constexpr double times_spacing = 8;
constexpr size_t padding = 3;        // points at one place that are none
constexpr size_t stray = 3;          // points in a row that may be none of the curve
constexpr size_t most_pieces = 100;  // each is compared with each
constexpr double beside = 0.6;       // share of a piece that lies along the other
constexpr double most_faulty = 0.1;  // of the frames: beyond, the file is of another kind

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

/// Runs of points at one place, as padding leaves them, become one point, and none at the file's
/// origin; how many points that were.
size_t drop_padding(std::vector<ContourPoint>& points) {
  const size_t before = points.size();
  std::vector<ContourPoint> kept;
  for (size_t first = 0, end; first < points.size(); first = end) {
    for (end = first + 1; end < points.size() && gap(points[first], points[end]) == 0;) ++end;
    const auto& at = points[first].position;
    const bool origin = at[0] == 0 && at[2] == 0;
    const size_t keep = end - first < padding ? end - first : origin ? 0 : 1;
    kept.insert(kept.end(), points.begin() + long(first), points.begin() + long(first + keep));
  }
  points = std::move(kept);
  return before - points.size();
}

/// True where most of `b` lies beside `a`: the nearest point of `a` is none of its ends. The root
/// runs on below the dorsum, but beyond the end of what was traced there.
bool retraces(const Piece& a, const Piece& b) {
  const auto beside_a = [&](const ContourPoint& p) {
    const auto nearest = std::min_element(
        a.begin(), a.end(), [&](const auto& q, const auto& r) { return gap(p, q) < gap(p, r); });
    return nearest != a.begin() && nearest != a.end() - 1;
  };
  return double(std::count_if(b.begin(), b.end(), beside_a)) > beside * double(b.size());
}

/// What is wrong with the pieces of a frame; empty: nothing.
std::string fault_of(const std::vector<Piece>& pieces) {
  if (pieces.size() > most_pieces)
    return fmt::format("its points lie in {} pieces far from each other.", pieces.size());
  for (size_t a = 0; a < pieces.size(); ++a)
    for (size_t b = 0; b < a; ++b)
      if (retraces(pieces[a], pieces[b]) || retraces(pieces[b], pieces[a]))
        return fmt::format(
            "its points go on for {} and start again beside them, {} mm away: two takes in one "
            "frame?",
            pieces[b].size(), std::lround(1e3 * gap(pieces[b].back(), pieces[a].front())));
  return {};
}

/// What was done with a frame.
struct Kept {
  bool curve = false;
  size_t padding = 0;  ///< points left out that repeat one place
  size_t out = 0;      ///< and that lie far off
  std::string fault;   ///< why it has no points any more
};

Kept keep_the_curve(ContourFrame& frame) {
  auto& points = frame.points;
  if (!std::all_of(points.begin(), points.end(), [](const auto& p) { return p.kind == "curve"; }))
    return {};
  const size_t padded = drop_padding(points);
  if (points.size() < 6) return {false, padded, 0, {}};
  std::vector<Piece> pieces = pieces_of(points);
  std::erase_if(pieces, [](const Piece& piece) { return piece.size() <= stray; });
  Kept kept{true, padded, points.size(), fault_of(pieces)};
  points.clear();
  if (!kept.fault.empty()) return kept;
  for (const Piece& piece : pieces) points.insert(points.end(), piece.begin(), piece.end());
  kept.out -= points.size();
  return kept;
}

}  // namespace

ContourFile with_one_curve_a_frame(ContourFile file, const std::string& path) {
  size_t out = 0, padded = 0, frames = 0, curves = 0, faulty = 0;
  int first = 0, first_faulty = 0;
  std::string fault;
  for (ContourFrame& frame : file.frames) {
    const Kept kept = keep_the_curve(frame);
    curves += kept.curve, padded += kept.padding;
    if (kept.padding > 0)
      frame.add_note(fmt::format("{} points that repeat one place left out", kept.padding));
    if (!kept.fault.empty()) {
      if (faulty++ == 0) first_faulty = frame.number, fault = kept.fault;
      frame.add_note(kept.fault);
    } else if (kept.out > 0) {
      if (frames++ == 0) first = frame.number;
      out += kept.out;
      frame.add_note(fmt::format("{} points far from their neighbours left out", kept.out));
    }
  }
  if (double(faulty) > most_faulty * double(curves))
    throw InputError(
        fmt::format("{}: frame {}: {} Expected one curve a frame", path, first_faulty, fault));
  if (faulty > 0)
    file.remarks.push_back(
        fmt::format("frames that are not one curve get no answer: {} of {}, the "
                    "first is frame {}: {}",
                    faulty, curves, first_faulty, fault));
  if (padded > 0)
    file.remarks.push_back(
        fmt::format("points that repeat one place are left out, as padding: {}", padded));
  if (out > 0)
    file.remarks.push_back(fmt::format(
        "points far from their neighbours are left out: {} in {} frames, the first in frame {}",
        out, frames, first));
  return file;
}

}  // namespace genio
