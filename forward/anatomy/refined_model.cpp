#include "forward/anatomy/refined_model.hpp"

#include <map>
#include <set>

#include "forward/anatomy/refine.hpp"
#include "forward/effects/modes/moved_rest.hpp"

namespace genio {
namespace {

/// Node of the finer mesh in the middle of two others. By the elements: the middle of a warped face
/// lies on neither of its diagonals.
class Middles {
 public:
  explicit Middles(const RefinedMesh& fine) {
    for (const auto& grid : fine.grids)
      for (int a = 0; a < 27; ++a)
        for (int b = 0; b < 27; ++b) {
          const int i = a % 3 + b % 3, j = a / 3 % 3 + b / 3 % 3, k = a / 9 + b / 9;
          if (a == b || i % 2 || j % 2 || k % 2) continue;
          at_[{grid[size_t(a)], grid[size_t(b)]}] = grid[size_t(i / 2 + 3 * (j / 2) + 9 * (k / 2))];
        }
  }
  int operator()(int a, int b) const {
    const auto it = at_.find({a, b});
    return it == at_.end() ? -1 : it->second;
  }

 private:
  std::map<std::pair<int, int>, int> at_;
};

Fibre with_middles(const Fibre& fibre, const Middles& middle) {
  Fibre result;
  for (size_t k = 0; k < fibre.size(); ++k) {
    if (k > 0 && fibre[k - 1].node >= 0 && fibre[k].node >= 0)
      if (const int m = middle(fibre[k - 1].node, fibre[k].node); m >= 0)
        result.push_back({m, Vec3::Zero()});
    result.push_back(fibre[k]);
  }
  return result;
}

/// The fibre half way between two that run side by side; empty where they do not.
Fibre between(const Fibre& a, const Fibre& b, const Middles& middle) {
  if (a.size() != b.size()) return {};
  Fibre result;
  bool apart = false;
  for (size_t k = 0; k < a.size(); ++k) {
    const int p = a[k].node, q = b[k].node;
    if ((p < 0) != (q < 0)) return {};
    if (p < 0) {
      result.push_back({-1, 0.5 * (a[k].anchor + b[k].anchor)});
      continue;
    }
    const int m = p == q ? p : middle(p, q);
    if (m < 0) return {};
    apart |= p != q;
    result.push_back({m, Vec3::Zero()});
  }
  return apart ? result : Fibre{};
}

/// A muscle's fibres and those between all neighbours, each once: on a finer mesh the same fibres
/// would be wires that cut into the tissue between them.
std::vector<Fibre> denser(const std::vector<Fibre>& fibres, const Middles& middle) {
  std::vector<Fibre> result = fibres;
  std::set<std::vector<int>> known;
  for (size_t i = 0; i < fibres.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      Fibre f = between(fibres[i], fibres[j], middle);
      std::vector<int> nodes;
      for (const FibrePoint& p : f) nodes.push_back(p.node);
      if (!f.empty() && known.insert(nodes).second) result.push_back(std::move(f));
    }
  for (Fibre& f : result) f = with_middles(f, middle);
  return result;
}

/// The same tongue without regard to its modes.
ModelDescription split(const ModelDescription& description) {
  ModelDescription d = description;
  const RefinedMesh fine = refined(description.mesh, description.supports);
  const Middles middle(fine);
  d.mesh = fine.mesh, d.supports = fine.supports;
  for (Muscle& muscle : d.muscles) {
    muscle.fibres = denser(muscle.fibres, middle);
    std::vector<int> children;
    for (int e : muscle.elements)
      for (int c = 0; c < 8; ++c) children.push_back(8 * e + c);
    muscle.elements = std::move(children);
  }
  return d;
}

}  // namespace

ModelDescription refined(const ModelDescription& description) {
  ModelDescription d = split(description);
  // New points are means of old ones, so that a mode is what refining moves along with it.
  for (size_t k = 0; k < d.modes.size(); ++k) {
    std::vector<double> one(d.modes.size(), 0.0);
    one[k] = 1;
    const ModelDescription far = split(moved(description, one));
    d.modes[k].nodes = far.mesh.nodes;
    d.modes[k].fixed_points = fixed_points(far.muscles);
    const auto before = fixed_points(d.muscles);
    for (size_t a = 0; a < d.mesh.nodes.size(); ++a) d.modes[k].nodes[a] -= d.mesh.nodes[a];
    for (size_t i = 0; i < before.size(); ++i) d.modes[k].fixed_points[i] -= before[i];
  }
  return d;
}

}  // namespace genio
