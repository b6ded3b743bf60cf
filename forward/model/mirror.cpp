#include "forward/model/mirror.hpp"

#include <cmath>
#include <map>

#include "forward/effects/surroundings/contact.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/half_model.hpp"
#include "forward/model/sums.hpp"

namespace genio {
namespace {

constexpr double same_place = 1e-6;    // [m]
constexpr double same_force = 1e-6;    // of the largest
constexpr double same_surface = 1e-4;  // [m], about what its sampling leaves
constexpr double touching = 4e-3;      // [m]
constexpr double trial_command = 0.1;  // activation

/// Node at the mirror image of each node; empty where one has none.
std::vector<int> partners(const HexMesh& mesh) {
  using Key = std::array<long long, 3>;
  std::map<Key, int> at;
  const auto key = [](const Vec3& x, const Vec3& shift) {
    Key k;
    for (int i = 0; i < 3; ++i) k[size_t(i)] = std::llround((x[i] + shift[i]) / (4 * same_place));
    return k;
  };
  for (size_t a = 0; a < mesh.nodes.size(); ++a) at[key(mesh.nodes[a], Vec3::Zero())] = int(a);
  std::vector<int> result;
  for (const Vec3& x : mesh.nodes) {
    const Vec3 image(x[0], -x[1], x[2]);
    int found = -1;
    for (int c = 0; c < 27 && found < 0; ++c) {  // rounding may fall into a neighbouring cell
      const Eigen::Vector3i cell(c % 3 - 1, c / 3 % 3 - 1, c / 9 - 1);
      const Vec3 shift = same_place * cell.cast<double>();
      if (const auto it = at.find(key(image, shift)); it != at.end())
        if ((mesh.nodes[size_t(it->second)] - image).norm() < same_place) found = it->second;
    }
    if (found < 0) return {};
    result.push_back(found);
  }
  return result;
}

bool symmetric(const Vector& f, const std::vector<int>& partner, double tolerance) {
  for (size_t a = 0; a < partner.size(); ++a) {
    Vec3 image = node_position(f, partner[a]);
    image[1] = -image[1];
    if ((node_position(f, int(a)) - image).norm() > tolerance) return false;
  }
  return true;
}

/// A symmetric shape near rest that strains everything.
Positions trial_shape(const Model& m) {
  Positions x = at_anatomy(m)->rest;
  for (size_t a = 0; a < m.mesh.nodes.size(); ++a) {
    const Vec3& r = m.mesh.nodes[a];
    const double s = std::sin(90 * r[0] + 50 * r[2]), c = std::cos(70 * r[2] - 30 * r[0]);
    x.segment<3>(3 * Eigen::Index(a)) += 1e-4 * Vec3(s, 40 * r[1] * c, s * c);
  }
  return x;
}

Parameters trial_parameters(const Model& m) {
  Parameters p = default_parameters(m);
  for (const Muscle& muscle : m.muscles)
    for (int k : command_parameters(m, muscle.name))
      p[k] = trial_command * m.parameters[size_t(k)].info.upper;
  return p;
}

/// Forces but for those of contact, whose surfaces are compared by themselves: meshes of a palate
/// are symmetric to less than their forces would tell.
Forces force_of_tongue(const Model& m, const Positions& x, const Parameters& p) {
  return forces_of(m, x, p, [](const Effect& e) { return !e.contact; });
}

/// What the tongue may touch is the same on both sides.
bool symmetric_surfaces(const Model& given) {
  const auto here = at_anatomy(given);
  const Model& m = *here;
  for (const auto& contact : m.contacts)
    for (const Quad& q : m.surface)
      for (int a : q)
        for (double up : {0.0, 5e-3, 1e-2}) {
          const Vec3 x = m.mesh.nodes[size_t(a)] + up * Vec3::UnitZ();
          const double d = contact->distance(x), e = contact->distance({x[0], -x[1], x[2]});
          if (std::min(d, e) < touching && std::abs(d - e) > same_surface) return false;
        }
  return true;
}

/// The half's forces are the whole's: on the plane half of them, but across it.
bool same_forces(const Model& half, const Mirror& mirror, const Positions& x, const Vector& f) {
  const Forces g = force_of_tongue(half, mirror.right_half(x), trial_parameters(half));
  const double tolerance = same_force * f.cwiseAbs().maxCoeff();
  for (size_t a = 0; a < mirror.right.size(); ++a) {
    const int whole = mirror.right[a];
    const bool middle = std::abs(half.mesh.nodes[a][1]) < on_plane;
    for (int i = 0; i < 3; ++i)
      if (!(middle && i == 1) &&
          std::abs(g[3 * Eigen::Index(a) + i] - (middle ? 0.5 : 1) * f[3 * whole + i]) > tolerance)
        return false;
  }
  return true;
}

std::optional<Model> right_half_of(const Model& m) {
  try {
    return build_model(half_of(*m.description, m.name), m.name + ", right half");
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

Matrix Mirror::whole(const Matrix& of_half) const {
  Matrix result(3 * Eigen::Index(node.size()), of_half.cols());
  for (size_t a = 0; a < node.size(); ++a) {
    const auto to = 3 * Eigen::Index(a);
    result.middleRows<3>(to) = of_half.middleRows<3>(3 * node[a]);
    result.row(to + 1) *= side[a];
  }
  return result;
}

Matrix Mirror::right_half(const Matrix& of_whole) const {
  Matrix result(3 * Eigen::Index(right.size()), of_whole.cols());
  for (size_t a = 0; a < right.size(); ++a)
    result.middleRows<3>(3 * Eigen::Index(a)) = of_whole.middleRows<3>(3 * right[a]);
  return result;
}

std::unique_ptr<const Mirror> mirror_of(const Model& m, const std::vector<std::string>& names) {
  if (!m.description || m.is_moved) return nullptr;
  const std::vector<int> partner = partners(m.mesh);
  if (partner.empty()) return nullptr;
  const Positions x = trial_shape(m);
  const Parameters p = trial_parameters(m);
  const Forces f = force_of_tongue(m, x, p);
  if (!symmetric(f, partner, same_force * f.cwiseAbs().maxCoeff())) return nullptr;
  for (const std::string& name : names) {
    const int k[] = {parameter_index(m, name)};
    const Vector d = force_derivatives(m, x, p, k).col(0);
    if (!symmetric(d, partner, same_force * d.cwiseAbs().maxCoeff())) return nullptr;
  }
  if (!symmetric_surfaces(m)) return nullptr;
  auto half = right_half_of(m);
  if (!half) return nullptr;
  auto result = std::make_unique<Mirror>(Mirror{std::move(*half), {}, {}, {}});
  std::vector<int> number(m.mesh.nodes.size(), -1);
  for (size_t a = 0; a < number.size(); ++a)
    if (m.mesh.nodes[a][1] > -on_plane) {
      number[a] = int(result->right.size());
      result->right.push_back(int(a));
    }
  for (size_t a = 0; a < number.size(); ++a) {
    const bool left = number[a] < 0;
    result->node.push_back(left ? number[size_t(partner[a])] : number[a]);
    result->side.push_back(left ? -1 : 1);
  }
  if (!same_forces(result->half, *result, x, f)) return nullptr;
  return result;
}

}  // namespace genio
