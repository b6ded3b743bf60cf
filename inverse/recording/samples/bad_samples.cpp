#include "inverse/recording/samples/bad_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/base/median.hpp"

namespace genio {
namespace {

constexpr double high_rms = 30;    // of AG50x, in its own units; a good sensor has 3 to 15
constexpr double rms_factor = 5;   // over the sensor's median
constexpr size_t frozen_run = 5;   // samples at least
constexpr double others_move = 2;  // [mm] meanwhile, at least
constexpr double jump = 15;        // [mm] from one sample to the next
constexpr double jump_factor = 8;  // over the others' steps and over the sensor's usual one

double millimetres(const SensorTable& t) {
  return t.axes.units == "um" ? 1e-3 : t.axes.units == "cm" ? 10 : 1;
}

int drop(SensorTable& t, size_t c, size_t first, size_t last) {
  int count = 0;
  for (size_t s = first; s < last; ++s)
    if (t.samples[s][c].allFinite()) {
      t.samples[s][c].setConstant(std::numeric_limits<double>::quiet_NaN());
      ++count;
    }
  return count;
}

void drop_by_rms(SensorTable& t, size_t c) {
  if (t.rms.size() != t.samples.size()) return;
  std::vector<double> values;
  for (size_t s = 0; s < t.rms.size(); ++s)
    if (t.samples[s][c].allFinite() && std::isfinite(t.rms[s][c]))
      values.push_back(std::abs(t.rms[s][c]));
  const double usual = median(values), limit = std::max(high_rms, rms_factor * usual);
  int count = 0;
  for (size_t s = 0; s < t.rms.size(); ++s)
    if (std::abs(t.rms[s][c]) > limit) count += drop(t, c, s, s + 1);
  if (count > 0)
    t.remarks.push_back(fmt::format("sensor {}: {} of {} samples left out, RMS above {:.3g}",
                                    t.names[c], count, values.size(), limit));
  if (usual > high_rms)
    t.remarks.push_back(fmt::format(
        "sensor {}: its RMS is about {:.3g}, that of a good one below {:.0f}; do not trust it",
        t.names[c], usual, high_rms));
}

/// The longest way of another sensor between the first of these samples and the rest [mm].
double others_way(const SensorTable& t, size_t c, size_t first, size_t last) {
  double way = 0;
  for (size_t k = 0; k < t.names.size(); ++k) {
    if (k == c || !t.samples[first][k].allFinite()) continue;
    for (size_t s = first + 1; s < last; ++s)
      if (t.samples[s][k].allFinite())
        way = std::max(way, (t.samples[s][k] - t.samples[first][k]).norm());
  }
  return way * millimetres(t);
}

void drop_frozen(SensorTable& t, size_t c) {
  int count = 0;
  size_t at = 0;
  for (size_t first = 0, last = 0; first < t.samples.size(); first = last) {
    const Vec3 p = t.samples[first][c];
    for (last = first + 1; last < t.samples.size() && t.samples[last][c] == p;) ++last;
    if (!p.allFinite() || last - first < frozen_run) continue;
    if (others_way(t, c, first, last) < others_move) continue;
    if (count == 0) at = first;
    count += drop(t, c, first, last);
  }
  if (count > 0)
    t.remarks.push_back(
        fmt::format("sensor {} is frozen: {} of {} samples have the same value while others move, "
                    "from sample {} on; left out",
                    t.names[c], count, t.samples.size(), at + 1));
}

void drop_jumps(SensorTable& t, size_t c) {
  const double mm = millimetres(t);
  std::vector<size_t> seen;
  for (size_t s = 0; s < t.samples.size(); ++s)
    if (t.samples[s][c].allFinite()) seen.push_back(s);
  std::vector<double> steps;
  for (size_t i = 1; i < seen.size(); ++i)
    steps.push_back(mm * (t.samples[seen[i]][c] - t.samples[seen[i - 1]][c]).norm());
  const double usual = median(steps);
  std::vector<size_t> starts = {0};  // of the stretches between jumps, in `seen`
  double largest = 0;
  for (size_t i = 1; i < seen.size(); ++i) {
    if (steps[i - 1] < jump || steps[i - 1] < jump_factor * usual) continue;
    double others = -1;
    for (size_t k = 0; k < t.names.size(); ++k)
      if (k != c && t.samples[seen[i]][k].allFinite() && t.samples[seen[i - 1]][k].allFinite())
        others = std::max(others, mm * (t.samples[seen[i]][k] - t.samples[seen[i - 1]][k]).norm());
    if (others < 0 || steps[i - 1] < jump_factor * others) continue;
    starts.push_back(i), largest = std::max(largest, steps[i - 1]);
  }
  if (starts.size() == 1) return;
  starts.push_back(seen.size());
  size_t best = 0;
  for (size_t k = 1; k + 1 < starts.size(); ++k)
    if (starts[k + 1] - starts[k] > starts[best + 1] - starts[best]) best = k;
  // Stretches that lie where the longest one ends or begins belong to it: a spike is between them.
  const auto place = [&](size_t k) { return t.samples[seen[starts[k]]][c]; };
  const auto place_end = [&](size_t k) { return t.samples[seen[starts[k + 1] - 1]][c]; };
  const Vec3 low = place(best), high = place_end(best);
  int count = 0;
  for (size_t k = 0; k + 1 < starts.size(); ++k) {
    if (k == best) continue;
    const double off = mm * std::min((place(k) - high).norm(), (place_end(k) - low).norm());
    if (off < jump) continue;
    count += drop(t, c, seen[starts[k]], seen[starts[k + 1] - 1] + 1);
  }
  t.remarks.push_back(
      fmt::format("sensor {} jumps by {:.0f} mm, first at sample {}, while the others stay; {} of "
                  "{} samples left out. Did it come off?",
                  t.names[c], largest, seen[starts[1]] + 1, count, seen.size()));
}

}  // namespace

void drop_bad_samples(SensorTable& table, size_t c, bool on_tongue) {
  drop_by_rms(table, c);
  if (!on_tongue) return;
  drop_frozen(table, c);
  drop_jumps(table, c);
}

}  // namespace genio
