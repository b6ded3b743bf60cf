#include "data/generator/generic_muscles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace genio::generic {
namespace {

struct Grid {
  int i, j, k;
};

/// Fibres of one side as grid paths, k >= 0 to the right.
using Paths = std::vector<std::vector<Grid>>;

/// Fractions of the resolution, so that a finer grid has the same anatomy.
struct Layout {
  Resolution r;
  int i(double u) const { return int(std::lround(u * r.along)); }
  int j(double d) const { return int(std::lround(d * r.deep)); }
  int k(double w) const { return int(std::lround(w * r.across)); }
};

/// From the front line straight to the surface.
Paths fan(const Layout& l, double from, double to, const std::vector<int>& sheets) {
  Paths paths;
  for (int i = l.i(from); i <= l.i(to); ++i)
    for (int k : sheets) {
      std::vector<Grid> p;
      for (int j = 0; j <= l.r.deep; ++j) p.push_back({i, j, k});
      paths.push_back(std::move(p));
    }
  return paths;
}

/// Along the surface line within layer j.
std::vector<Grid> arc(int i0, int i1, int j, int k) {
  std::vector<Grid> p;
  const int step = i1 >= i0 ? 1 : -1;
  for (int i = i0; i != i1 + step; i += step) p.push_back({i, j, k});
  return p;
}

Paths transversus(const Layout& l) {
  Paths paths;
  for (int i = l.i(0.15); i <= l.i(0.70); ++i)
    for (int j = l.j(0.4); j <= l.j(0.85); ++j) {
      std::vector<Grid> p;
      for (int k = l.k(0.8); k >= 0; --k) p.push_back({i, j, k});
      paths.push_back(std::move(p));
    }
  return paths;
}

Paths verticalis(const Layout& l) {
  Paths paths;
  for (int i = l.i(0.36); i <= l.i(0.57); ++i)
    for (int k = l.k(0.4); k <= l.k(0.8); ++k) {
      std::vector<Grid> p;
      for (int j = l.r.deep; j >= l.j(0.62); --j) p.push_back({i, j, k});
      paths.push_back(std::move(p));
    }
  return paths;
}

Paths mylohyoid(const Layout& l) {
  Paths paths;
  for (int i : {l.r.along, l.r.along - 1})
    for (int j = l.j(0.2); j <= l.j(0.7); ++j) {
      std::vector<Grid> p;
      for (int k = l.r.across; k >= 0; --k) p.push_back({i, j, k});
      paths.push_back(std::move(p));
    }
  return paths;
}

/// From the side of the tongue body forwards, inwards and down; the styloid end is added later.
/// Nine fibres a side: a few would tear a sharp edge into the surface.
Paths styloglossus(const Layout& l) {
  Paths paths;
  for (int down = 0; down < 3; ++down)
    for (int inward = 0; inward < 3; ++inward) {
      std::vector<Grid> p;
      const int first = l.i(0.56), last = l.i(0.15);
      const int layer = l.r.deep - l.j(0.17 * (down + 1)), sheet = l.r.across - l.k(0.2 * inward);
      for (int i = first; i >= last; --i) {
        const double way = double(first - i) / (first - last);
        p.push_back({i, std::max(1, int(std::lround(layer - 0.30 * l.r.deep * way * way))),
                     std::max(1, int(std::lround(sheet - 0.45 * l.r.across * way * way)))});
      }
      paths.push_back(std::move(p));
    }
  return paths;
}

/// From the hyoid up the side of the tongue body.
Paths hyoglossus(const Layout& l) {
  Paths paths;
  for (double depth : {0.83, 0.67, 0.5})
    for (double side : {0.6, 0.8, 1.0})
      paths.push_back(arc(l.r.along - 1, l.i(0.48), l.j(depth), l.k(side)));
  return paths;
}

Paths inferior_longitudinal(const Layout& l) {
  Paths paths;
  for (double depth : {0.67, 0.5})
    for (double side : {0.2, 0.4, 0.6})
      if (depth > 0.6 || side < 0.5) paths.push_back(arc(0, l.r.along - 1, l.j(depth), l.k(side)));
  return paths;
}

std::vector<int> touched_elements(const HexMesh& mesh, const std::vector<Fibre>& fibres) {
  std::vector<bool> on(mesh.nodes.size(), false);
  std::vector<std::array<int, 2>> segments;
  for (const auto& f : fibres)
    for (size_t s = 0; s + 1 < f.size(); ++s)
      if (f[s].node >= 0 && f[s + 1].node >= 0) segments.push_back({f[s].node, f[s + 1].node});
  std::vector<int> elements;
  for (size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& n = mesh.elements[e];
    const bool touched = std::any_of(segments.begin(), segments.end(), [&](const auto& s) {
      return std::find(n.begin(), n.end(), s[0]) != n.end() &&
             std::find(n.begin(), n.end(), s[1]) != n.end();
    });
    if (touched) elements.push_back(int(e));
  }
  return elements;
}

}  // namespace

std::vector<Muscle> make_muscles(const Resolution& r, const NodeAt& node, const HexMesh& mesh) {
  const Layout l{r};
  const int in = 1;
  struct Entry {
    const char* name;
    double max_force;  // both sides [N]
    Paths paths;
  };
  std::vector<Entry> table = {
      {"GGP", 37, fan(l, 0.50, 0.79, {in, in + 1})},
      {"GGM", 12, fan(l, 0.36, 0.43, {in, in + 1})},
      {"GGA", 18, fan(l, 0.20, 0.34, {in, in + 1})},
      {"STY", 24, styloglossus(l)},
      {"HG", 65, hyoglossus(l)},
      {"VERT", 20, verticalis(l)},
      {"TRANS", 50, transversus(l)},
      {"IL", 9, inferior_longitudinal(l)},
      {"GH", 17.5, fan(l, 0.97, 1.0, {in, in + 1})},
      {"MH", 39, mylohyoid(l)},
  };
  std::vector<Muscle> muscles;
  for (const Entry& entry : table)
    for (int side : {-1, 1}) {  // y < 0 is the speaker's left
      Muscle m;
      m.name = std::string(entry.name) + (side < 0 ? "_L" : "_R");
      m.max_force = 0.5 * entry.max_force;
      for (const auto& path : entry.paths) {
        Fibre f;
        if (m.name.starts_with("STY")) f.push_back({-1, 1e-3 * Vec3(150, side * 36.0, 125)});
        for (const Grid& g : path) f.push_back({node(g.i, g.j, side * g.k), Vec3::Zero()});
        m.fibres.push_back(std::move(f));
      }
      muscles.push_back(std::move(m));
    }
  Muscle sl;
  sl.name = "SL";
  sl.max_force = 19;
  for (int k = -l.k(0.6); k <= l.k(0.6); ++k) {
    Fibre f;
    for (const Grid& g : arc(1, r.along - 2, r.deep, k))
      f.push_back({node(g.i, g.j, g.k), Vec3::Zero()});
    sl.fibres.push_back(std::move(f));
  }
  muscles.push_back(std::move(sl));
  for (auto& m : muscles) m.elements = touched_elements(mesh, m.fibres);
  return muscles;
}

}  // namespace genio::generic
