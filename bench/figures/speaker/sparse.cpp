#include "bench/figures/speaker/sparse.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "forward/base/median.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/recording/registration/registration.hpp"
#include "speaker/adaptation/outline_of_model.hpp"
#include "speaker/modes/anatomy_estimate.hpp"
#include "speaker/outline/outline_facing.hpp"

namespace genio::bench {
namespace {

constexpr double ninety = 1.6449, seen_noise = 5e-4;  // [sd], [m]

OutlinePoints of_speaker(const std::string& path, const std::string& speaker) {
  return outline_points(facing_model(read_outline(path, speaker)));
}

/// What a palate trace and a probe see, with noise; no point tells where it belongs.
SpeakerSight in_sight(const OutlinePoints& points, std::mt19937& random) {
  std::normal_distribution<double> noise(0, seen_noise);
  SpeakerSight sight;
  sight.lines = {{{}, true, seen_noise}, {{}, false, seen_noise}};
  const OutlineStretch& palate = outline_stretch("palate");
  for (int i : points_in_sight())
    sight.lines[i < palate.first ? 1 : 0].points.push_back(points.places[size_t(i)] +
                                                           Vec2(noise(random), noise(random)));
  return sight;
}

/// The points that nobody sees, of the tongue's line and the hyoid.
std::vector<int> hidden_points() {
  const auto seen = points_in_sight();
  std::vector<int> hidden;
  for (const OutlineStretch& s : outline_stretches())
    if (s.name != "palate" && s.name != "pharynx")
      for (int i = s.first; i < s.first + s.count; ++i)
        if (std::find(seen.begin(), seen.end(), i) == seen.end()) hidden.push_back(i);
  return hidden;
}

/// Places moved by rigid motion and scale so that those in sight lie nearest to a speaker's, where
/// it is told which of them belong together.
std::vector<Vec2> scaled_onto(const OutlinePoints& from, const OutlinePoints& to) {
  std::vector<int> both;
  for (int i : points_in_sight())
    if (from.known[size_t(i)] && to.known[size_t(i)]) both.push_back(i);
  const Similarity rigid = rigidly_laid(from.places, to.places, both);
  Vec2 middle = Vec2::Zero(), there = Vec2::Zero();
  for (int i : both)
    middle += rigid(from.places[size_t(i)]) / double(both.size()),
        there += to.places[size_t(i)] / double(both.size());
  double product = 0, square = 0;
  for (int i : both) {
    const Vec2 a = rigid(from.places[size_t(i)]) - middle;
    product += a.dot(to.places[size_t(i)] - there), square += a.squaredNorm();
  }
  std::vector<Vec2> moved;
  for (const Vec2& p : from.places) moved.push_back(there + product / square * (rigid(p) - middle));
  return moved;
}

/// The model's places in the speaker's frame as recordings are registered: by what was seen alone,
/// with no word of which point is which.
std::vector<Vec2> registered_to(const std::vector<Vec2>& from, const Model& model,
                                const TongueReach& reach, const SpeakerSight& sight) {
  const Similarity s =
      register_by_palate(model, reach, sight.lines[0].points, {sight.lines[1].points}).transform;
  const Eigen::Rotation2Dd back(-s.angle);
  std::vector<Vec2> moved;
  for (const Vec2& p : from) moved.push_back(back * Vec2((p - s.shift) / s.scale));
  return moved;
}

double rms_of(const std::vector<Vec2>& places, const OutlinePoints& truth,
              const std::vector<int>& which) {
  double square = 0;
  for (int i : which) square += (places[size_t(i)] - truth.places[size_t(i)]).squaredNorm();
  return std::sqrt(square / double(which.size()));
}

}  // namespace

Json sparse_figures(const BenchOptions& o, const Progress& progress) {
  const ModelDescription description = read_description(o.model);
  const Model model = build_model(description, o.model);
  const TongueReach reach = reach_of(model);
  SpeakerOutline own = outline_of_model(
      description, [](const Vec2& p) { return p; }, 1e-3);
  const OutlinePoints generic = outline_points(own);
  std::vector<OutlinePoints> all;
  for (const std::string& speaker : outline_speakers(o.data))
    all.push_back(of_speaker(o.data, speaker));
  std::vector<int> hidden = hidden_points(), shared;
  for (int i : hidden)
    if (generic.known[size_t(i)]) shared.push_back(i);
  int held = 0, counted = 0, nearer = 0, nearer_than_told = 0;
  std::vector<double> ours, scaled, told, sd;
  std::mt19937 random(o.seed);
  Json rows = Json::array();
  for (size_t k = 0; k < all.size(); ++k) {
    std::vector<OutlinePoints> others = all;
    others.erase(others.begin() + std::ptrdiff_t(k));
    const OutlineModes modes = modes_of_outlines(others);
    const SpeakerSight sight = in_sight(all[k], random);
    const AnatomyEstimate e = estimate_anatomy(modes, sight);
    int here = 0;
    for (int i : hidden)
      for (int axis = 0; axis < 2; ++axis) {
        const double off = e.places[size_t(i)][axis] - all[k].places[size_t(i)][axis];
        here += std::abs(off) < ninety * e.sd[2 * i + axis];
        sd.push_back(e.sd[2 * i + axis]);
      }
    held += here, counted += 2 * int(hidden.size());
    ours.push_back(rms_of(e.places, all[k], shared));
    scaled.push_back(rms_of(registered_to(generic.places, model, reach, sight), all[k], shared));
    told.push_back(rms_of(scaled_onto(generic, all[k]), all[k], shared));
    nearer += ours.back() < scaled.back();
    nearer_than_told += ours.back() < told.back();
    rows.push_back({{"rms_mm", 1e3 * ours.back()},
                    {"scaled_rms_mm", 1e3 * scaled.back()},
                    {"told_rms_mm", 1e3 * told.back()},
                    {"held", double(here) / (2.0 * double(hidden.size()))},
                    {"fit_rms_mm", 1e3 * e.rms},
                    {"kept", modes.kept}});
    progress(fmt::format(
        "speaker {:>2}: {:.1f} mm, scaled model {:.1f} mm; {:.0f} % within; seen {:.2f} mm", k + 1,
        1e3 * ours.back(), 1e3 * scaled.back(), 100.0 * here / (2.0 * double(hidden.size())),
        1e3 * e.rms));
  }
  return {{"speakers", all.size()},
          {"sparse_coverage90", double(held) / counted},
          {"sparse_nearer", nearer},
          {"sparse_nearer_than_told", nearer_than_told},
          {"sparse_rms_mm_median", 1e3 * median(ours)},
          {"scaled_rms_mm_median", 1e3 * median(scaled)},
          {"told_rms_mm_median", 1e3 * median(told)},
          {"sparse_sd_mm_median", 1e3 * median(sd)},
          {"each", rows}};
}

}  // namespace genio::bench
