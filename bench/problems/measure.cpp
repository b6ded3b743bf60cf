#include "bench/problems/measure.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>

#include "forward/model/build_effects.hpp"
#include "forward/tissue/tongue_faces.hpp"
#include "inverse/target/tongue_line.hpp"

namespace genio::bench {
namespace {

/// Where rays from inside leave the tongue's own surface.
class Rays {
 public:
  Rays(const Model& model, const Positions& x) {
    half_ = std::all_of(model.mesh.nodes.begin(), model.mesh.nodes.end(),
                        [](const Vec3& n) { return n[1] > -1e-6; });
    // Four triangles about the middle: by a diagonal a warped face would be another one in the
    // mirror.
    for (const Quad& q : free_faces(model.mesh, model.supports)) {
      std::array<Vec3, 4> corner;
      for (size_t k = 0; k < 4; ++k) corner[k] = node_position(x, q[k]);
      const Vec3 middle = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
      for (size_t k = 0; k < 4; ++k) triangles_.push_back({middle, corner[k], corner[(k + 1) % 4]});
    }
  }
  /// False where the ray meets nothing.
  bool operator()(const Vec3& from, Vec3 along, Vec3& hit) const {
    const double side = half_ && along[1] < 0 ? -1 : 1;
    along[1] *= side;
    double farthest = -1;
    for (const auto& [a, b, c] : triangles_) {
      const Vec3 u = b - a, v = c - a;
      const Vec3 n = along.cross(v);
      const double det = u.dot(n);
      if (std::abs(det) < 1e-16) continue;
      const Vec3 off = from - a;
      const double p = off.dot(n) / det;
      const double q = along.dot(off.cross(u)) / det;
      const double s = v.dot(off.cross(u)) / det;
      if (p >= -1e-9 && q >= -1e-9 && p + q <= 1 + 1e-9 && s > farthest) farthest = s;
    }
    hit = from + farthest * along;
    hit[1] *= side;
    return farthest > 0;
  }

 private:
  bool half_ = false;
  std::vector<std::array<Vec3, 3>> triangles_;
};

constexpr double depth = 0.015;  // of the rays' origin below the top [m]

}  // namespace

std::vector<Measured> contours_of(const Model& model, const Positions& x, int line, int across) {
  std::vector<Measured> points;
  for (const Vec2& q : TongueLine(model).sample(x, line))
    points.push_back({Vec3(q[0], 0, q[1]), "curve", 0});
  const Rays rays(model, x);
  int slice = 0;
  for (double off : {-0.012, 0.012}) {
    ++slice;
    Vec3 from = node_position(model.rest, model.landmarks.dorsum);
    from += Vec3(off, 0, 0), from[1] = 0;
    Vec3 top;
    if (!rays(Vec3(from[0], 0, from[2] - 0.02), Vec3::UnitZ(), top)) continue;
    from[2] = top[2] - depth;
    for (int i = 0; i < across; ++i) {
      const double angle = (-1.2 + 2.4 * i / (across - 1));
      Vec3 hit;
      if (rays(from, Vec3(0, std::sin(angle), std::cos(angle)), hit))
        points.push_back({hit, "surface", slice});
    }
  }
  return points;
}

std::vector<Measured> surface_of(const Model& model, const Positions& x, int scattered,
                                 std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const Rays rays(model, x);
  const Vec3 tip = node_position(x, model.landmarks.tip);
  const Vec3 dorsum = node_position(x, model.landmarks.dorsum);
  const Vec3 root = node_position(x, model.landmarks.root);
  std::vector<Measured> points;
  for (int tries = 0; tries < 20 * scattered && int(points.size()) < scattered; ++tries) {
    const double s = uniform(random), angle = -1.2 + 2.4 * uniform(random);
    const Vec3 along =
        s < 0.5 ? Vec3(tip + 2 * s * (dorsum - tip)) : Vec3(dorsum + (2 * s - 1) * (root - dorsum));
    const Vec3 from = along + Vec3(s < 0.5 ? 0.005 : -0.01, -along[1], -depth);
    const Vec3 up = s < 0.5 ? Vec3(0, 0, 1) : Vec3(2 * s - 1, 0, 2 - 2 * s).normalized();
    Vec3 hit;
    if (rays(from, std::cos(angle) * up + std::sin(angle) * Vec3::UnitY(), hit))
      points.push_back({hit, "surface", 0});
  }
  return points;
}

Target target_of(const std::vector<Measured>& points, double sigma) {
  Target t;
  for (const auto& p : points)
    if (p.kind == "curve") t.curve.push_back({Vec2(p.position[0], p.position[2]), sigma});
    else t.surface.push_back({p.position, sigma, p.slice});
  return t;
}

void add_noise(std::vector<Measured>& points, double sd, double length, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::map<std::pair<std::string, int>, std::vector<size_t>> contours;
  for (size_t i = 0; i < points.size(); ++i)
    contours[{points[i].kind, points[i].slice}].push_back(i);
  for (const auto& [key, members] : contours) {
    const auto n = Eigen::Index(members.size());
    Matrix c(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        c(i, j) = std::exp(
            -(points[members[size_t(i)]].position - points[members[size_t(j)]].position).norm() /
            length);
    const Matrix factor = c.llt().matrixL();
    for (int axis = 0; axis < 3; ++axis) {
      Vector e(n);
      for (auto& v : e) v = normal(random);
      e = sd * (factor * e);
      if (key.first == "curve" && axis == 1) continue;
      if (key.second > 0 && axis == 0) continue;  // a slice stays in its plane
      for (Eigen::Index i = 0; i < n; ++i) points[members[size_t(i)]].position[axis] += e[i];
    }
  }
}

}  // namespace genio::bench
