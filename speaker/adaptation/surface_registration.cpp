#include "speaker/adaptation/surface_registration.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "forward/geometry/quad4.hpp"
#include "forward/geometry/surfaces/closest_point.hpp"
#include "speaker/adaptation/solid_registration.hpp"

namespace genio {
namespace {

constexpr std::array surface_stiffnesses = {1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-5};  // [m]
constexpr double along_surface = 0.01;  // part of the weight that holds places along it
constexpr double farthest_foot = 0.02;  // [m]
constexpr size_t most_samples = 3000;   // of the given surface
constexpr int affine_rounds = 30;

Mat3 across_surface(const Vec3& normal, double weight) {
  const Vec3 n = normal.normalized();
  return weight * (along_surface * Mat3::Identity() + (1 - along_surface) * n * n.transpose());
}

HexMesh placed(HexMesh mesh, const Positions& x) {
  for (size_t a = 0; a < mesh.nodes.size(); ++a) mesh.nodes[a] = node_position(x, int(a));
  return mesh;
}

/// Pulls from the mesh's faces to the surface and from the surface's vertices to the mesh.
std::vector<Pull> surface_pulls(const HexMesh& mesh, const std::vector<Quad>& faces,
                                const SurfaceDistance& target, const TriangleSurface& surface) {
  std::vector<Pull> pulls;
  static const auto points = quad4::gauss_points();
  int near = -1;
  for (const Quad& q : faces)
    for (const auto& p : points) {
      Vec3 place = Vec3::Zero(), u = place, v = place;
      for (size_t i = 0; i < 4; ++i) {
        const Vec3& x = mesh.nodes[size_t(q[i])];
        place += p.value[i] * x, u += p.by[i][0] * x, v += p.by[i][1] * x;
      }
      const Vec3 normal = u.cross(v);
      const auto foot = target.foot(place, near);
      if (foot.on_rim || (foot.place - place).norm() > farthest_foot ||
          normal.normalized().dot(foot.normal.normalized()) < 0.2)
        continue;
      Pull pull;
      for (size_t i = 0; i < 4; ++i) pull.nodes[i] = q[i], pull.weights[i] = p.value[i];
      pull.goal = foot.place, pull.metric = across_surface(foot.normal, normal.norm());
      pulls.push_back(pull);
    }
  const TriangleSurface ours = outer_surface(mesh);
  const SurfaceDistance to_ours(ours);
  double area = 0;
  for (const auto& t : surface.triangles)
    area += 0.5 * (surface.vertices[size_t(t[1])] - surface.vertices[size_t(t[0])])
                      .cross(surface.vertices[size_t(t[2])] - surface.vertices[size_t(t[0])])
                      .norm();
  const size_t stride = std::max<size_t>(1, surface.triangles.size() / most_samples);
  const double share = area * double(stride) / double(surface.triangles.size());
  int at = -1;
  for (size_t k = 0; k < surface.triangles.size(); k += stride) {
    const auto& t = surface.triangles[k];
    const Vec3 &a = surface.vertices[size_t(t[0])], &b = surface.vertices[size_t(t[1])],
               &c = surface.vertices[size_t(t[2])];
    const Vec3 place = (a + b + c) / 3, normal = (b - a).cross(c - a);
    if (!(normal.norm() > 0)) continue;
    const auto foot = to_ours.foot(place, at);
    if (at < 0 || (foot.place - place).norm() > farthest_foot ||
        normal.normalized().dot(foot.normal.normalized()) < 0.2)
      continue;
    const auto& own = ours.triangles[size_t(at)];
    const auto w =
        closest_on_triangle(place, ours.vertices[size_t(own[0])], ours.vertices[size_t(own[1])],
                            ours.vertices[size_t(own[2])]);
    pulls.push_back({{own[0], own[1], own[2], -1},
                     {w[0], w[1], w[2], 0},
                     place,
                     across_surface(normal, share)});
  }
  return pulls;
}

}  // namespace

TriangleSurface outer_surface(const HexMesh& mesh) {
  TriangleSurface s{mesh.nodes, {}};
  for (const Quad& q : boundary_quads(mesh)) {
    s.triangles.push_back({q[0], q[1], q[2]});
    s.triangles.push_back({q[0], q[2], q[3]});
  }
  return s;
}

HexMesh affinely_laid(const HexMesh& mesh, const TriangleSurface& target) {
  const TriangleSurface ours = outer_surface(mesh);
  std::vector<bool> outer(mesh.nodes.size(), false);
  for (const auto& t : ours.triangles)
    for (int a : t) outer[size_t(a)] = true;
  const auto box_of = [](const TriangleSurface& s) {
    Eigen::AlignedBox3d box;
    for (const auto& t : s.triangles)
      for (int a : t) box.extend(s.vertices[size_t(a)]);
    return box;
  };
  const Eigen::AlignedBox3d from = box_of(ours), to = box_of(target);
  const Vec3 scale = to.sizes().cwiseQuotient(from.sizes());
  HexMesh moved = mesh;
  for (Vec3& x : moved.nodes) x = to.center() + scale.cwiseProduct(x - from.center());
  const SurfaceDistance distance(target);
  for (int round = 0; round < affine_rounds; ++round) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Matrix<double, 4, 3> right = Eigen::Matrix<double, 4, 3>::Zero();
    for (size_t a = 0; a < mesh.nodes.size(); ++a) {
      if (!outer[a]) continue;
      const auto foot = distance.foot(moved.nodes[a]);
      if (foot.on_rim) continue;
      const Eigen::Vector4d row(1, mesh.nodes[a][0] - from.center()[0],
                                mesh.nodes[a][1] - from.center()[1],
                                mesh.nodes[a][2] - from.center()[2]);
      normal += row * row.transpose();
      right += row * foot.place.transpose();
    }
    const Eigen::Matrix<double, 4, 3> solution = normal.ldlt().solve(right);
    for (size_t a = 0; a < mesh.nodes.size(); ++a) {
      const Vec3 p = mesh.nodes[a] - from.center();
      moved.nodes[a] = solution.transpose() * Eigen::Vector4d(1, p[0], p[1], p[2]);
    }
  }
  return moved;
}

SurfaceRegistration register_surface(
    const HexMesh& mesh, const TriangleSurface& surface,
    const std::function<std::vector<Pull>(const Positions&)>& more) {
  const SurfaceDistance target(surface);
  const std::vector<Quad> faces = boundary_quads(mesh);
  FoldFreeProblem problem{&mesh, corner_shapes(mesh), {}, 1, 0, 0.35, {}, {}};
  Positions x = rest_positions(mesh);
  for (size_t e = 0; e < mesh.elements.size(); ++e)
    problem.volumes.push_back(element_volume(mesh, x, int(e)));
  problem.supports.assign(mesh.nodes.size(), Support::free);
  SurfaceRegistration result;
  for (double stiffness : surface_stiffnesses) {
    problem.stiffness = stiffness, problem.quality = 0.3 * stiffness;
    problem.pulls = surface_pulls(placed(mesh, x), faces, target, surface);
    if (more) {
      const std::vector<Pull> others = more(x);
      problem.pulls.insert(problem.pulls.end(), others.begin(), others.end());
    }
    x = minimise_fold_free(problem, x, {.most_steps = 10, .small_step = 2e-5}).x;
  }
  for (int repair = 0; repair < 4; ++repair) {
    result.min_jacobian = least_corner_jacobian_ratio(placed(mesh, x));
    if (result.min_jacobian >= 1.1 * least_corner_ratio) break;
    problem.quality *= 5;
    x = minimise_fold_free(problem, x, {.most_steps = 10, .small_step = 1e-5}).x;
  }
  result.mesh = placed(mesh, x);
  result.min_jacobian = least_corner_jacobian_ratio(result.mesh);
  double squares = 0, count = 0;
  std::vector<bool> outer(mesh.nodes.size(), false);
  for (const Quad& q : faces)
    for (int a : q) outer[size_t(a)] = true;
  for (size_t a = 0; a < mesh.nodes.size(); ++a) {
    if (!outer[a]) continue;
    const auto foot = target.foot(result.mesh.nodes[a]);
    if (foot.on_rim) continue;
    const double d = (foot.place - result.mesh.nodes[a]).norm();
    squares += d * d, ++count;
    result.most = std::max(result.most, d);
  }
  result.rms = count > 0 ? std::sqrt(squares / count) : 0;
  return result;
}

}  // namespace genio
