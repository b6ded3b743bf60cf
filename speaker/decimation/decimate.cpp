#include "speaker/decimation/decimate.hpp"

#include <Eigen/Geometry>
#include <limits>
#include <queue>

#include "speaker/decimation/distance_guard.hpp"
#include "speaker/decimation/quadric.hpp"
#include "speaker/solid/edge_list.hpp"
#include "speaker/solid/hausdorff.hpp"

namespace genio {
namespace {

constexpr double usual_kept_part = 0.3;  // the bound in the region over the bound elsewhere
constexpr double rim_weight = 10;        // of planes that hold a rim, over those of triangles
constexpr int most_tries = 6;            // with bounds that are drawn closer
constexpr int many = 16000;              // triangles; above, deviations are not measured one by one
constexpr double small_change = 1e-5;    // [m], of what is done without measuring
constexpr double grown = 1.1;            // of a deviation that is measured anew
constexpr double none = std::numeric_limits<double>::infinity();

/// An edge that might collapse. Its cost is a squared distance [m^2]: first what the quadrics
/// tell, which is an average, and then the largest that was measured.
struct Candidate {
  double cost;
  int a, b;
  int age_a, age_b;
  Vec3 at;
  bool measured;
  bool operator<(const Candidate& other) const {  // the least one comes first, in a fixed order
    return std::tie(other.cost, other.a, other.b) < std::tie(cost, a, b);
  }
};

class Decimation {
 public:
  /// `kept`: how many times a distance counts in the region.
  Decimation(const TriangleSurface& surface, const KeptRegion& keep, double kept)
      : mesh_(surface),
        quadric_(surface.vertices.size()),
        area_(surface.vertices.size(), 0),
        age_(surface.vertices.size(), 0) {
    for (const auto& t : surface.triangles) {
      const Vec3 &a = surface.vertices[size_t(t[0])], &b = surface.vertices[size_t(t[1])],
                 &c = surface.vertices[size_t(t[2])];
      const Vec3 n = (b - a).cross(c - a);
      if (!(n.norm() > 0)) continue;
      const double scale = keep.holds((a + b + c) / 3) ? kept * kept : 1;
      for (const int v : t)
        quadric_[size_t(v)].add_plane(n.normalized(), a - origin(), scale * n.norm() / 6),
            area_[size_t(v)] += n.norm() / 6;
    }
    const auto sides = sides_by_edge(surface);
    each_edge(sides, [&](auto first, auto last) {
      if (last - first == 1) hold_rim(surface, *first);
    });
  }

  /// Small changes, by the quadrics alone.
  void run(int triangles, double most) {
    fill_queue();
    while (!queue_.empty() && mesh_.triangle_count() > triangles) {
      const Candidate c = queue_.top();
      queue_.pop();
      if (c.cost > most * most) break;
      if (stands(c) && mesh_.keeps_shape(c.a, c.b, c.at)) join(c.a, c.b, c.at);
    }
  }

  /// The least change first, as it is measured; none beyond `most`.
  void run(int triangles, double most, DistanceGuard& guard) {
    for (bool moved = true; moved && mesh_.triangle_count() > triangles;) {
      fill_queue();
      moved = false;  // what was refused may be let after others have moved
      while (!queue_.empty() && mesh_.triangle_count() > triangles) {
        Candidate c = queue_.top();
        queue_.pop();
        if (!stands(c) || !find_place(c)) continue;
        const double far = guard.deviation(mesh_, c.a, c.b, c.at, most);
        if (far > most) continue;
        const double cost = std::max(c.cost, far * far);
        if (!c.measured || cost > grown * c.cost) {
          c.cost = cost, c.measured = true;
          queue_.push(c);
          continue;
        }
        guard.done();
        join(c.a, c.b, c.at);
        moved = true;
      }
    }
  }

  TriangleSurface surface() const { return mesh_.surface(); }

 private:
  /// Of the quadrics: a place on the surface.
  const Vec3& origin() {
    if (!origin_) origin_ = mesh_.place(0);
    return *origin_;
  }

  void hold_rim(const TriangleSurface& surface, const TriangleSide& side) {
    const auto& t = surface.triangles[size_t(side.triangle)];
    const Vec3 &low = surface.vertices[size_t(side.low)],
               &high = surface.vertices[size_t(side.high)];
    const Vec3 face = (surface.vertices[size_t(t[1])] - surface.vertices[size_t(t[0])])
                          .cross(surface.vertices[size_t(t[2])] - surface.vertices[size_t(t[0])]);
    const Vec3 across = face.cross(high - low);
    if (!(across.norm() > 0)) return;
    for (const int v : {side.low, side.high})
      quadric_[size_t(v)].add_plane(across.normalized(), low - origin(),
                                    rim_weight * (high - low).squaredNorm());
  }

  bool stands(const Candidate& c) const {
    return age_[size_t(c.a)] == c.age_a && age_[size_t(c.b)] == c.age_b && mesh_.may_join(c.a, c.b);
  }

  /// The best place, or else one of the two there are; false where no triangle may stand so.
  bool find_place(Candidate& c) const {
    for (const Vec3& at : {c.at, mesh_.place(c.a), mesh_.place(c.b)})
      if (mesh_.keeps_shape(c.a, c.b, at)) return c.at = at, true;
    return false;
  }

  void push(int a, int b) {
    if (a > b) std::swap(a, b);
    Quadric q = quadric_[size_t(a)];
    q += quadric_[size_t(b)];
    const Vec3 at = q.least(0.5 * (mesh_.place(a) + mesh_.place(b)) - origin());
    const double weight = area_[size_t(a)] + area_[size_t(b)];
    queue_.push({weight > 0 ? q.at(at) / weight : 0, a, b, age_[size_t(a)], age_[size_t(b)],
                 at + origin(), false});
  }

  void fill_queue() {
    queue_ = {};
    for (size_t v = 0; v < mesh_.all_vertices(); ++v)
      for (const int other : mesh_.neighbours(int(v)))
        if (int(v) < other) push(int(v), other);
  }

  void join(int a, int b, const Vec3& at) {
    mesh_.join(a, b, at);
    quadric_[size_t(a)] += quadric_[size_t(b)];
    area_[size_t(a)] += area_[size_t(b)];
    ++age_[size_t(a)], ++age_[size_t(b)];
    for (const int other : mesh_.neighbours(a)) push(a, other);
  }

  CollapsingMesh mesh_;
  std::optional<Vec3> origin_;
  std::vector<Quadric> quadric_;
  std::vector<double> area_;  ///< of the planes in a vertex's quadric, a third of each [m^2]
  std::vector<int> age_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace

DecimatedSurface decimate(const TriangleSurface& surface, const DecimateOptions& options) {
  const double bound = options.distance.value_or(none);
  const double kept = std::min(bound, options.keep_distance.value_or(usual_kept_part * bound));
  // What deviates in the region counts by the ratio of the bounds.
  double ratio = usual_kept_part, most = bound;
  if (bound < none) ratio = kept / bound;
  else if (kept < none) most = kept / ratio;
  const DeviationScale scale{1 / std::max(ratio, 1e-3), &options.keep};
  Decimation first(surface, options.keep, scale.kept);
  if (int(surface.triangles.size()) > many)
    first.run(std::max(many, 2 * options.triangles), std::min(small_change, most / 10));
  const TriangleSurface start = first.surface();
  DecimatedSurface result{surface, 0, 0, false, true};
  double closer = 1;
  for (int tried = 0; tried < most_tries; ++tried) {
    Decimation decimation(start, options.keep, scale.kept);
    DistanceGuard guard(surface, start, scale);
    decimation.run(options.triangles, closer * most, guard);
    result.surface = decimation.surface();
    result.hausdorff = hausdorff_distance(surface, result.surface);
    if (!options.keep.empty())
      result.hausdorff_kept = hausdorff_distance(surface, result.surface, 2e-6, &options.keep);
    const double excess =
        std::max(result.hausdorff / bound, options.keep.empty() ? 0 : result.hausdorff_kept / kept);
    result.within_bounds = excess <= 1;
    if (result.within_bounds) break;
    closer *= 0.95 / excess;  // places between those that the guard looks at lie farther off
  }
  result.reached =
      options.triangles == 0 || int(result.surface.triangles.size()) <= options.triangles;
  return result;
}

}  // namespace genio
