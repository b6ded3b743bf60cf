#include "bench/truths/beyond_reach.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

namespace genio::bench {
namespace {

constexpr double field_length = 0.01;  // [m]
constexpr int bumps = 6;
constexpr double stretch = 0.1, open_least = 4, open_most = 12;  // -, [degrees]

/// Longer or shorter, higher or lower; bones stay away, as they are another speaker's.
ModelDescription other_anatomy(ModelDescription d, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.6, 1.4);
  const auto factor = [&] {
    const double sign = random() % 2 ? 1 : -1;
    return 1 + sign * stretch * part(random);
  };
  Vec3 by(factor(), 1, 1);
  by[2] = factor();
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : d.mesh.nodes) middle += x / double(d.mesh.nodes.size());
  const auto scaled = [&](const Vec3& x) -> Vec3 {
    return middle + by.cwiseProduct(x - middle).eval();
  };
  for (Vec3& x : d.mesh.nodes) x = scaled(x);
  for (Muscle& muscle : d.muscles)
    for (Fibre& fibre : muscle.fibres)
      for (auto& point : fibre)
        if (point.node < 0) point.anchor = scaled(point.anchor);
  d.effects.erase("palate_contact"), d.effects.erase("jaw_contact");
  return d;
}

}  // namespace

const char* to_string(Beyond kind) {
  switch (kind) {
    case Beyond::pushed_surface:
      return "pushed_surface";
    case Beyond::other_anatomy:
      return "other_anatomy";
    case Beyond::open_jaw:
      return "open_jaw";
  }
  return "";
}

ModelDescription beyond_tongue(const ModelDescription& model, Beyond kind, std::mt19937& random) {
  if (kind == Beyond::other_anatomy) return other_anatomy(model, random);
  if (kind != Beyond::open_jaw) throw std::invalid_argument("a pushed surface is no tongue's");
  ModelDescription d = model;
  d.effects["jaw_opening"]["angle"] =
      std::uniform_real_distribution<double>(open_least, open_most)(random);
  return d;
}

Target pushed(const Target& target, const Answer& answer, double noises, std::mt19937& random) {
  const Residuals& r = answer.residuals;
  std::uniform_int_distribution<size_t> which(0, r.rows.size() - 1);
  std::normal_distribution<double> height;
  Vector by = Vector::Zero(r.values.size());
  for (int k = 0; k < bumps; ++k) {
    const Vec3 centre = r.places[size_t(r.rows[which(random)].point)];
    const double high = height(random);
    for (size_t row = 0; row < r.rows.size(); ++row) {
      const Vec3 away = r.places[size_t(r.rows[row].point)] - centre;
      by[Eigen::Index(row)] +=
          high * std::exp(-0.5 * away.squaredNorm() / (field_length * field_length));
    }
  }
  // What forces within any bounds could follow is taken out.
  const Matrix j = residual_jacobian(r, answer.shape_by_unknown);
  by -= j * j.completeOrthogonalDecomposition().solve(by);
  by *= noises * std::sqrt(double(by.size())) / by.norm();
  Target result = target;
  for (size_t row = 0; row < r.rows.size(); ++row) {
    Vec3 across = Vec3::Zero();
    for (const auto& [node, g] : r.gradient[row]) across += g;
    const Vec3 moved = -by[Eigen::Index(row)] / std::abs(r.rows[row].scale) * across.normalized();
    const auto point = size_t(r.rows[row].point);
    if (point < result.curve.size()) result.curve[point].position += Vec2(moved[0], moved[2]);
    else result.surface[point - result.curve.size()].position += moved;
  }
  return result;
}

double noises_off(const Answer& answer) {
  const Vector& r = answer.residuals.values;
  return std::sqrt(std::max(0.0, r.squaredNorm() / double(r.size()) - 1));
}

}  // namespace genio::bench
