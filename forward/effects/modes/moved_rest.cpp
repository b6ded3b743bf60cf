#include "forward/effects/modes/moved_rest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace genio {
namespace {

void check_name(const std::string& name, std::set<std::string>& known) {
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) || c == '_');
  });
  if (name.empty() || !plain)
    throw InputError(fmt::format(
        "anatomy mode '{}': expected a name of letters, digits and '_' without spaces", name));
  if (!known.insert(name).second)
    throw InputError(fmt::format("anatomy mode '{}' is there twice", name));
}

const std::vector<Vec3>& vertices(const std::optional<TriangleSurface>& surface) {
  static const std::vector<Vec3> none;
  return surface ? surface->vertices : none;
}

std::vector<Vec3> sampled(const NamedField& mode, const std::vector<Vec3>& points) {
  std::vector<Vec3> result;
  for (const Vec3& x : points) {
    result.push_back(mode.field(x));
    if (!result.back().allFinite())
      throw InputError(
          fmt::format("anatomy mode '{}': the displacement at ({:g}, {:g}, {:g}) m is not finite",
                      mode.name, x[0], x[1], x[2]));
  }
  return result;
}

void check_count(const std::string& source, const AnatomyMode& mode, const char* what, size_t given,
                 size_t wanted) {
  if (given != wanted)
    throw InputError(fmt::format("{}: anatomy mode '{}' has {} displacements of {}; expected {}",
                                 source, mode.name, given, what, wanted));
}

void move(std::vector<Vec3>& points, double value, const std::vector<Vec3>& by) {
  for (size_t i = 0; i < points.size(); ++i) points[i] += value * by[i];
}

}  // namespace

std::vector<Vec3> fixed_points(const std::vector<Muscle>& muscles) {
  std::vector<Vec3> result;
  for (const Muscle& muscle : muscles)
    for (const Fibre& fibre : muscle.fibres)
      for (const FibrePoint& p : fibre)
        if (p.node < 0) result.push_back(p.anchor);
  return result;
}

ModelDescription with_modes(ModelDescription d, const std::vector<NamedField>& fields) {
  std::set<std::string> names;
  d.modes.clear();
  d.effects.erase("anatomy");
  for (const NamedField& mode : fields) {
    check_name(mode.name, names);
    d.modes.push_back({mode.name, sampled(mode, d.mesh.nodes),
                       sampled(mode, fixed_points(d.muscles)), sampled(mode, vertices(d.palate)),
                       sampled(mode, vertices(d.jaw)), sampled(mode, vertices(d.hyoid))});
    d.effects["anatomy"][mode.name] = 0;
  }
  return d;
}

void check_modes(const ModelDescription& d, const std::string& source) {
  const size_t fixed = fixed_points(d.muscles).size();
  for (const AnatomyMode& mode : d.modes) {
    check_count(source, mode, "nodes", mode.nodes.size(), d.mesh.nodes.size());
    check_count(source, mode, "fixed fibre points", mode.fixed_points.size(), fixed);
    check_count(source, mode, "the palate", mode.palate.size(), vertices(d.palate).size());
    check_count(source, mode, "the jaw", mode.jaw.size(), vertices(d.jaw).size());
    check_count(source, mode, "the hyoid", mode.hyoid.size(), vertices(d.hyoid).size());
  }
}

ModelDescription moved(ModelDescription d, std::span<const double> values) {
  for (size_t k = 0; k < d.modes.size(); ++k) {
    const AnatomyMode& mode = d.modes[k];
    if (values[k] == 0) continue;
    move(d.mesh.nodes, values[k], mode.nodes);
    size_t next = 0;
    for (Muscle& muscle : d.muscles)
      for (Fibre& fibre : muscle.fibres)
        for (FibrePoint& p : fibre)
          if (p.node < 0) p.anchor += values[k] * mode.fixed_points[next++];
    if (d.palate) move(d.palate->vertices, values[k], mode.palate);
    if (d.jaw) move(d.jaw->vertices, values[k], mode.jaw);
    if (d.hyoid) move(d.hyoid->vertices, values[k], mode.hyoid);
  }
  return d;
}

}  // namespace genio
