#include "inverse/recording/curves/aaa_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/base/median.hpp"
#include "inverse/recording/base/file_axes.hpp"

namespace genio {
namespace {

// Gaps between neighbouring knots of a tongue [mm]: any up to the first are its own, none beyond
// the second; between them, those that are no wider than a few usual ones.
constexpr double narrow_gap = 12, wide_gap = 40, usual_gaps = 3;
constexpr size_t most_strays = 3;  // in a row, between knots of the line

double distance(const AaaKnot& a, const AaaKnot& b) { return std::hypot(a.x - b.x, a.y - b.y); }

double widest_gap(const std::vector<AaaKnot>& knots) {
  std::vector<double> gaps;
  for (size_t k = 1; k < knots.size(); ++k) gaps.push_back(distance(knots[k - 1], knots[k]));
  if (gaps.empty()) return narrow_gap;
  return std::clamp(usual_gaps * median(std::move(gaps)), narrow_gap, wide_gap);
}

/// How many knots from `first` on stray from the line that ends in `last` and goes on behind them;
/// none where it does not go on.
size_t strays(const std::vector<AaaKnot>& knots, size_t first, const AaaKnot& last, double widest) {
  for (size_t n = 1; n <= most_strays && first + n < knots.size(); ++n)
    if (distance(last, knots[first + n]) <= double(n + 1) * widest) return n;
  return 0;
}

/// The longest run of knots without a wide gap, but where a few stray from it: the outermost knots
/// are often tracker noise.
std::vector<AaaKnot> without_far(const std::vector<AaaKnot>& knots) {
  const double widest = widest_gap(knots);
  std::vector<AaaKnot> best, run;
  for (size_t k = 0; k < knots.size(); ++k) {
    if (!run.empty() && distance(run.back(), knots[k]) > widest) {
      if (const size_t n = strays(knots, k, run.back(), widest); n > 0) {
        k += n;
      } else {
        if (run.size() > best.size()) best = run;
        run.clear();
      }
    }
    run.push_back(knots[k]);
  }
  return run.size() > best.size() ? run : best;
}

}  // namespace

AaaColumns aaa_columns(const std::vector<std::string>& titles) {
  AaaColumns c;
  for (size_t k = 0; k < titles.size(); ++k) {
    const std::string title = lower_case(trimmed(titles[k]));
    if (title == "prompt" && !c.label) c.label = k;
    else if (title == "time of sample in recording" && !c.time) c.time = k;
    else if (title.starts_with("client") && !c.speaker) c.speaker = k;
    else if (title.starts_with("date") && !c.recording) c.recording = k;
  }
  return c;
}

ContourFrame aaa_frame(int number, const AaaColumns& columns,
                       const std::vector<std::string>& fields, TableNumbers& numbers,
                       const TableLines& lines) {
  const auto text = [&](const std::optional<size_t>& column) {
    return column && *column < fields.size() ? trimmed(fields[*column]) : std::string();
  };
  ContourFrame frame;
  frame.number = number, frame.label = text(columns.label);
  frame.speaker = text(columns.speaker), frame.recording = text(columns.recording);
  if (const std::string time = text(columns.time);
      !is_missing(time) && !numbers.parse(time, frame.time_s))
    lines.fail(fmt::format("field {}, time of the sample: {}", *columns.time + 1,
                           numbers.complaint(time)));
  if (!frame.recording.empty() && frame.recording.find_first_of("0123456789") == std::string::npos)
    lines.fail(fmt::format("field {}: {} is no date of a recording", *columns.recording + 1,
                           in_quotes(frame.recording)));
  return frame;
}

void add_knots(ContourFrame& frame, const std::vector<AaaKnot>& knots, double least, bool tongue,
               AaaLosses& losses) {
  std::vector<AaaKnot> sure;
  for (const AaaKnot& knot : knots)
    if (!knot.confidence || *knot.confidence >= least) sure.push_back(knot);
  const auto kept = tongue ? without_far(sure) : sure;
  for (const AaaKnot& knot : kept) {
    ContourPoint& point = frame.points.emplace_back();
    point.position = {knot.x, not_given, knot.y}, point.kind = "curve";
    point.widening = knot.widening;
  }
  const size_t unsure = knots.size() - sure.size(), far = sure.size() - kept.size();
  losses.knots += int(knots.size()), losses.unsure += int(unsure), losses.far += int(far);
  losses.far_frames += far > 0;
  if (knots.empty()) frame.note = "the frame is empty (no knot has a value)";
  else if (kept.empty()) frame.note = fmt::format("all {} knots are of low confidence", unsure);
  else if (far > 0 && unsure > 0)
    frame.note =
        fmt::format("{} knots of low confidence and {} beyond a gap left out", unsure, far);
  else if (far > 0) frame.note = fmt::format("{} knots beyond a gap left out", far);
  else if (unsure > 0) frame.note = fmt::format("{} knots of low confidence left out", unsure);
}

void AaaHeadPoints::add(const std::string& spline, const std::vector<AaaKnot>& knots, size_t count,
                        double least) {
  const auto named = head_points_in(spline);
  const bool middle = named == std::vector{HeadPoint::hyoid};
  if (named.empty() || (!middle && named.size() != count)) return;
  std::vector<std::pair<Eigen::Vector2d, int>> sums(named.size(), {Eigen::Vector2d::Zero(), 0});
  for (const AaaKnot& knot : knots) {
    if (knot.confidence && *knot.confidence < least) continue;
    auto& [sum, summed] = sums[middle ? 0 : knot.place];
    sum += Eigen::Vector2d(knot.x, knot.y), ++summed;
  }
  for (size_t k = 0; k < named.size(); ++k)
    if (const auto& [sum, summed] = sums[k]; summed > 0)
      seen_.try_emplace(named[k], sum / double(summed));
}

void AaaHeadPoints::add_to(HeadPointTracks& tracks) const {
  for (const auto& [point, at] : seen_) tracks[point].push_back(at);
}

void remark_losses(ContourFile& file, const AaaLosses& losses, double least) {
  if (losses.unsure > 0)
    file.remarks.push_back(fmt::format("{} of {} knots left out: their confidence is below {:g}",
                                       losses.unsure, losses.knots, least));
  if (losses.far > 0)
    file.remarks.push_back(fmt::format(
        "{} of {} knots left out in {} frames: they lie beyond a gap that no tongue has",
        losses.far, losses.knots, losses.far_frames));
}

}  // namespace genio
