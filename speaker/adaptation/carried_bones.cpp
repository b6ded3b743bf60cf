#include "speaker/adaptation/carried_bones.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "forward/geometry/surfaces/bone_distance.hpp"
#include "forward/tissue/tongue_faces.hpp"
#include "speaker/outline/rigid_frame.hpp"

namespace genio {
namespace {

constexpr double bone_spacing = 3e-3, line_spacing = 3e-3;  // of pairs [m]
constexpr double near_palate = 15e-3, near_jaw = 8e-3;      // [m]
constexpr double clearance = 3e-4;                          // between tongue and bone at rest [m]
// Bending against squared distances; the first that folds nothing near the bones is taken.
constexpr std::array bone_smoothings = {2e-4, 2e-3, 1e-2, 5e-2, 0.5};
constexpr double least_bone_stretch = 0.15;  // of the affine map's
constexpr int bone_rounds = 3;

bool inside(const std::vector<Vec2>& closed, const Vec2& p) {
  bool in = false;
  for (size_t k = 0; k < closed.size(); ++k) {
    const Vec2 &a = closed[k], &b = closed[(k + 1) % closed.size()];
    if ((a[1] > p[1]) != (b[1] > p[1]) &&
        p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      in = !in;
  }
  return in;
}

/// The place, or the nearest one at least the clearance outside of the tongue's section.
Vec2 clear_of(const std::vector<Vec2>& section, const Polyline& around, const Vec2& p) {
  const Polyline::Foot foot = around.foot(p);
  const bool in = inside(section, p);
  if (!in && foot.distance >= clearance) return p;
  const Vec2 t = around.tangent(foot.s);
  return foot.place + clearance * Vec2(-t[1], t[0]);  // the line runs clockwise
}

std::vector<Vec2> samples_of(const std::vector<Vec2>& points) {
  const Polyline line(points);
  const int count = std::max(1, int(line.length() / bone_spacing));
  std::vector<Vec2> samples;
  for (int k = 0; k <= count; ++k) samples.push_back(line.at(line.length() * k / count));
  return samples;
}

/// The closest map through the pairs that folds nothing at them.
ThinPlateMap unfolded_map(const std::vector<PlacePair>& pairs) {
  std::vector<Vec2> places;
  for (const PlacePair& p : pairs) places.push_back(p.from);
  const double least = least_bone_stretch * least_stretch(affine_map(pairs), {places.front()});
  for (double smoothing : bone_smoothings)
    if (ThinPlateMap map(pairs, smoothing); least_stretch(map, places) > least) return map;
  return affine_map(pairs);
}

/// Where a bone's places should go: to the nearest of the outline's lines, unless that is far or
/// one of their ends.
struct BoneGoals {
  std::vector<Vec2> rest;  ///< of the bone's cut
  std::vector<Polyline> lines;
  double near;

  void add(const ThinPlateMap& map, const std::vector<Vec2>& section, const Polyline& around,
           std::vector<PlacePair>& pairs) const {
    for (const Vec2& p : rest) {
      const Vec2 now = map(p);
      Polyline::Foot best;
      best.distance = near;
      bool found = false;
      for (const Polyline& line : lines) {
        const Polyline::Foot foot = line.foot(now);
        if (foot.distance >= best.distance || foot.s <= 0 || foot.s >= line.length()) continue;
        best = foot, found = true;
      }
      if (found) pairs.push_back({p, clear_of(section, around, best.place)});
    }
  }
};

/// The part of the mandible's line that faces the tongue: from where the floor meets it up past the
/// floor of the mouth to its top.
std::vector<Vec2> inner_side_of_mandible(const SpeakerOutline& outline) {
  const Polyline bone(outline.segments.at(Segment::mandible)), tongue(outline.tongue());
  const TongueLandmarks marks = tongue_landmarks(outline);
  const double low = bone.foot(tongue.at(marks.genial)).s;
  const double middle = bone.foot(tongue.at(marks.floor)).s;
  size_t top = 0;
  for (size_t k = 0; k < bone.points().size(); ++k)
    if (bone.points()[k][1] > bone.points()[top][1]) top = k;
  double high = bone.arc()[top];
  if ((middle - low) * (high - middle) < 0) high = middle;  // the line's ends lie in between
  std::vector<Vec2> side;
  const int parts = std::max(2, int(std::abs(high - low) / 1e-3));
  for (int k = 0; k <= parts; ++k) side.push_back(bone.at(low + (high - low) * k / parts));
  return side;
}

/// Places of a bone's cut that face the tongue: no part of the cut stands before them. What lies
/// behind a bone goes with its front.
std::vector<Vec2> facing_samples(const std::optional<TriangleSurface>& surface,
                                 const Polyline& tongue) {
  std::vector<Vec2> facing;
  if (!surface) return facing;
  const auto cuts = midsagittal_cut(*surface);
  if (cuts.empty()) return facing;
  for (const Vec2& p : samples_of(cuts.front())) {
    const Vec2 foot = tongue.foot(p).place, before = p + 0.1 * (foot - p);
    bool free_way = true;
    for (const auto& cut : cuts)
      for (size_t k = 1; k < cut.size(); ++k)
        free_way &= !sides_cross(before, foot, cut[k - 1], cut[k]);
    if (free_way) facing.push_back(p);
  }
  return facing;
}

}  // namespace

CarriedBones carry_bones(const ModelDescription& model, const ModelLine& line, const Positions& x,
                         const SpeakerOutline& outline) {
  const Positions rest = rest_positions(model.mesh);
  std::vector<Vec2> before, section;
  for (int a : line.nodes) {
    before.emplace_back(rest[3 * a], rest[3 * a + 2]);
    section.emplace_back(x[3 * a], x[3 * a + 2]);
  }
  before.push_back(before.front());
  std::vector<Vec2> closed = section;
  closed.push_back(closed.front());
  const Polyline from(before), to(closed);
  std::vector<PlacePair> tongue;
  for (size_t k = 1; k < before.size(); ++k) {
    const double gap = from.arc()[k] - from.arc()[k - 1];
    const int parts = std::max(1, int(std::lround(gap / line_spacing)));
    for (int i = 0; i < parts; ++i) {
      const double t = double(i) / parts;
      tongue.push_back(
          {(1 - t) * before[k - 1] + t * before[k], (1 - t) * closed[k - 1] + t * closed[k]});
    }
  }
  std::vector<BoneGoals> goals;
  BoneGoals palate{facing_samples(model.palate, from), {}, near_palate};
  if (outline.has(Segment::palate))
    if (const auto side = underside_of_palate(outline.segments.at(Segment::palate)); !side.empty())
      palate.lines.emplace_back(side);
  if (outline.has(Segment::pharynx))
    palate.lines.emplace_back(outline.segments.at(Segment::pharynx));
  BoneGoals jaw{facing_samples(model.jaw, from), {}, near_jaw};
  if (outline.has(Segment::mandible) && !outline.free_surface_only)
    jaw.lines.emplace_back(inner_side_of_mandible(outline));
  CarriedBones carried;
  carried.map = ThinPlateMap(tongue, bone_smoothings.front());
  // The incisors' edge, an end of both lines, is a place that they share.
  if (!palate.lines.empty() && outline.has(Segment::palate) && model.palate) {
    const auto theirs = underside_of_palate(outline.segments.at(Segment::palate));
    const auto cuts = midsagittal_cut(*model.palate);
    const auto ours = cuts.empty() ? std::vector<Vec2>{} : underside_of_palate(cuts.front());
    if (!theirs.empty() && !ours.empty())
      tongue.push_back({ours.front(), clear_of(section, to, theirs.front())});
  }
  for (int round = 0; round < bone_rounds; ++round) {
    std::vector<PlacePair> pairs = tongue;
    for (const BoneGoals* g : {&palate, &jaw}) g->add(carried.map, section, to, pairs);
    carried.map = unfolded_map(pairs);
  }
  if (outline.has(Segment::palate) && model.palate) {
    const auto cuts = midsagittal_cut(*model.palate);
    if (!cuts.empty()) {
      std::vector<Vec2> moved;
      for (const Vec2& p : cuts.front()) moved.push_back(carried.map(p));
      const Polyline ours(moved);
      double squares = 0, count = 0;
      for (const Vec2& p : front_of_palate(outline.segments.at(Segment::palate))) {
        const double d = ours.foot(p).distance;
        squares += d * d, ++count;
      }
      if (count > 0) carried.palate_rms = std::sqrt(squares / count);
    }
  }
  return carried;
}

double rest_overlap(const ModelDescription& model) {
  std::vector<Vec3> free;
  std::vector<bool> seen(model.mesh.nodes.size(), false);
  for (const Quad& q : free_faces(model.mesh, model.supports))
    for (int a : q)
      if (!seen[size_t(a)]) seen[size_t(a)] = true, free.push_back(model.mesh.nodes[size_t(a)]);
  double deepest = 0;
  for (const auto* surface : {&model.palate, &model.jaw}) {
    if (!*surface) continue;
    const BoneDistance distance(facing_tongue(**surface, model.mesh.nodes));
    for (const Vec3& p : free) deepest = std::max(deepest, -distance(p));
  }
  return deepest;
}

}  // namespace genio
