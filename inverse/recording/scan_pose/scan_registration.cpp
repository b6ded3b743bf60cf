#include "inverse/recording/scan_pose/scan_registration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "forward/base/thin.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/model/model.hpp"
#include "inverse/recording/registration/postures.hpp"
#include "inverse/recording/scan_pose/scan_fit.hpp"

namespace genio {
namespace {

// A scan is one posture, and one off the rest shape looks like a head that is off: it says less
// alone than beside a palate.
constexpr double weight_beside_palate = 60, weight_alone = 70;
constexpr size_t enough_points = 240, few_points = 60;
constexpr double same_turn = 5 * std::numbers::pi / 180, same_way = 3e-3;
constexpr int rough_steps = 15, most_steps = 60;
constexpr size_t refined = 8;    // rough optima that are followed to their end
constexpr double hopeless = 40;  // cost above the best of one that nobody will ask for

/// Where the middle of a scan may lie: of the tongue's whole surface, and of its upper half.
std::vector<Vec3> middles_of(const SurfaceReach& reach) {
  std::vector<Vec3> all, upper;
  for (const Facet& f : reach.facets) all.push_back(node_position(reach.rest, f[0]));
  const Vec3 middle = mean(all);
  for (const Vec3& p : all)
    if (p[2] > middle[2]) upper.push_back(p);
  return {middle, mean(upper)};
}

struct Rough {
  Mat3 level;
  ScanFit fit;
};

std::vector<Rough> rough_fits(const ScanProblem& problem, const std::vector<Mat3>& levels,
                              const std::vector<Vec3>& middles) {
  ScanProblem rough = problem;
  rough.points = thin(problem.points, few_points);
  rough.trace = thin(problem.trace, few_points);
  std::vector<Rough> fits;
  for (const Mat3& level : levels)
    for (const Vec3& middle : middles)
      for (double tilt : {-0.5, 0.0, 0.5}) {
        rough.level = level;
        const Mat3 turn = Eigen::AngleAxisd(tilt, Vec3::UnitY()).toRotationMatrix() * level;
        const ScanPose pose{.turn = turn, .shift = middle - turn * problem.centre};
        fits.push_back({level, fit_scan(rough, pose, false, rough_steps)});
      }
  std::stable_sort(fits.begin(), fits.end(),
                   [](const Rough& a, const Rough& b) { return a.fit.cost < b.fit.cost; });
  return fits;
}

/// What the scan says of its size when nothing is believed of it.
void add_free_scale(ScanRegistration& r, ScanProblem problem) {
  problem.free = true, problem.level = r.level;
  const ScanFit freed = fit_scan(problem, r.pose, true, most_steps);
  r.free_scale = freed.pose.scale, r.free_gain = r.cost - freed.cost;
}

ScanRegistration registration_of(const ScanProblem& problem, const ScanFit& fit) {
  ScanRegistration r{.pose = fit.pose, .cost = fit.cost};
  std::vector<Vec3> moved;
  for (const Vec3& q : problem.points) moved.push_back(fit.pose(q));
  r.off_reach = rms_from_surface(problem.reach.facets, fit.shape, moved);
  double square = 0;
  for (const Vec3& q : problem.trace) {
    const Vec3 at = fit.pose(q);
    square += (at - problem.palate->foot(at).place).squaredNorm() / double(problem.trace.size());
  }
  r.palate_rms = std::sqrt(square);
  const auto sd = [&](int k) { return std::sqrt(std::max(0.0, fit.spread(k, k))); };
  r.tilt_sd = sd(1), r.shift_sd = std::max(sd(4), sd(6));
  return r;
}

}  // namespace

Vec3 mean(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / std::max<double>(1, double(points.size()));
}

SurfaceReach surface_reach_of(const Model& model) {
  SurfaceReach reach{facets(model.surface), at_anatomy(model)->rest, {}};
  reach.scale_sd = model.description->scale_sd;
  std::vector<int> nodes;
  for (const Quad& q : model.surface) nodes.insert(nodes.end(), q.begin(), q.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const Matrix modes = principal_modes(postures_of(model), 3, [&](const Positions& x) {
    Vector row(3 * Eigen::Index(nodes.size()));
    for (size_t i = 0; i < nodes.size(); ++i)
      row.segment<3>(3 * Eigen::Index(i)) = node_position(x, nodes[i]);
    return row;
  });
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    Positions& mode = reach.modes.emplace_back(Positions::Zero(model.rest.size()));
    for (size_t i = 0; i < nodes.size(); ++i)
      mode.segment<3>(3 * nodes[i]) = modes.col(k).segment<3>(3 * Eigen::Index(i));
  }
  return reach;
}

std::vector<ScanRegistration> register_scan(const Model& model, const SurfaceReach& reach,
                                            const Scan& scan, const std::vector<Mat3>& levels) {
  const bool by_palate = !scan.palate.empty();
  if (by_palate && !model.palate)
    throw InputError("registration needs a palate; the model file has none in [surfaces]");
  const auto palate =
      by_palate ? std::make_unique<SurfaceDistance>(*at_anatomy(model)->palate) : nullptr;
  ScanProblem problem{.reach = reach,
                      .palate = palate.get(),
                      .points = thin(scan.tongue, enough_points),
                      .trace = thin(scan.palate, enough_points),
                      .weight = by_palate ? weight_beside_palate : weight_alone};
  problem.centre = mean(by_palate ? problem.trace : problem.points);
  const auto middles =
      by_palate ? std::vector<Vec3>{mean(model.palate->vertices)} : middles_of(reach);
  std::vector<ScanRegistration> results;
  std::vector<ScanPose> followed;
  for (const Rough& rough : rough_fits(problem, levels, middles)) {
    if (followed.size() >= refined) break;
    const auto known = [&](const auto& list, const ScanPose& pose, const auto& pose_in) {
      return std::any_of(list.begin(), list.end(), [&](const auto& other) {
        return near_place(pose_in(other), pose, problem.centre, same_turn, same_way);
      });
    };
    if (known(followed, rough.fit.pose, [](const ScanPose& p) { return p; })) continue;
    followed.push_back(rough.fit.pose);
    problem.level = rough.level;
    const ScanFit fit = fit_scan(problem, rough.fit.pose, true, most_steps);
    if (known(results, fit.pose, [](const ScanRegistration& r) { return r.pose; })) continue;
    results.push_back(registration_of(problem, fit));
    results.back().level = rough.level;
  }
  std::stable_sort(results.begin(), results.end(),
                   [](const auto& a, const auto& b) { return a.cost < b.cost; });
  std::erase_if(results,
                [best = results.front().cost](const auto& r) { return r.cost > best + hopeless; });
  for (ScanRegistration& r : results) add_free_scale(r, problem);
  return results;
}

bool near_place(const ScanPose& a, const ScanPose& b, const Vec3& middle, double turn, double way) {
  return rotation_vector(a.turn * b.turn.transpose()).norm() < turn &&
         (a(middle) - b(middle)).norm() < way;
}

double rms_from_surface(const std::vector<Facet>& facets, const Positions& shape,
                        const std::vector<Vec3>& points) {
  const FacetSurface surface(facets, shape);
  double sum = 0;
  for (const Vec3& q : points) sum += surface.foot(surface.nearest(q), q).square;
  return std::sqrt(sum / std::max<double>(1, double(points.size())));
}

}  // namespace genio
