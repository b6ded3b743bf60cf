#include "speaker/adaptation/adapt.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "speaker/adaptation/carried_bones.hpp"
#include "speaker/adaptation/surface_registration.hpp"
#include "speaker/outline/outline_checks.hpp"
#include "speaker/outline/outline_facing.hpp"
#include "speaker/outline/rigid_frame.hpp"

namespace genio {
namespace {

// What a tracing of the speaker leaves open of his size, as a logarithm.
constexpr double own_scale_sd = 0.01;

/// The area that a muscle's fibres fill: the volume of its elements over its fibres' mean length
/// [m^2].
double cross_section(const Muscle& muscle, const HexMesh& mesh) {
  const Positions x = rest_positions(mesh);
  double volume = 0, length = 0;
  for (int e : muscle.elements) volume += element_volume(mesh, x, e);
  for (const Fibre& fibre : muscle.fibres)
    length += fibre_length(fibre, x) / double(muscle.fibres.size());
  return length > 0 ? volume / length : 0;
}

void carry_surface(std::optional<TriangleSurface>& surface, const ThinPlateMap& map,
                   double lateral) {
  if (!surface) return;
  for (Vec3& v : surface->vertices) v = map.in_space(v, lateral);
}

/// Scales maximum forces with the cross-sections; the geometric mean of the factors.
double scale_forces(const ModelDescription& base, ModelDescription& model) {
  double logarithms = 0;
  for (size_t m = 0; m < model.muscles.size(); ++m) {
    const double before = cross_section(base.muscles[m], base.mesh);
    const double after = cross_section(model.muscles[m], model.mesh);
    const double factor = before > 0 && after > 0 ? after / before : 1;
    model.muscles[m].max_force *= factor;
    logarithms += std::log(factor) / double(model.muscles.size());
  }
  return std::exp(logarithms);
}

/// How much wider a mesh has become, by all its nodes.
double widening(const HexMesh& before, const HexMesh& after) {
  double product = 0, square = 0;
  for (size_t k = 0; k < before.nodes.size(); ++k) {
    product += before.nodes[k][1] * after.nodes[k][1];
    square += before.nodes[k][1] * before.nodes[k][1];
  }
  return square > 0 ? product / square : 1;
}

/// Of a place that moves with the outline.
Vec3 moved_place(const SpeakerOutline& outline, const Similarity& to_model, const Vec3& p) {
  const Vec2 q = to_model(Vec2(outline.mirrored ? -p[0] : p[0], p[2]));
  return {q[0], p[1], q[1]};
}

/// What goes with the mesh, once that is known.
void carry_along(const ModelDescription& base, const ModelLine& line, const std::string& who,
                 Adaptation& a) {
  const Positions x = rest_positions(a.model.mesh);
  a.volume = mesh_volume(a.model.mesh, x);
  const double lateral = widening(base.mesh, a.model.mesh);
  const CarriedBones bones = carry_bones(base, line, x, a.outline);
  a.palate_rms = bones.palate_rms;
  for (auto* surface : {&a.model.palate, &a.model.jaw, &a.model.hyoid})
    carry_surface(*surface, bones.map, lateral);
  for (Muscle& muscle : a.model.muscles)
    for (Fibre& fibre : muscle.fibres)
      for (FibrePoint& p : fibre)
        if (p.node < 0) p.anchor = bones.map.in_space(p.anchor, lateral);
  a.rest_overlap = rest_overlap(a.model);
  a.max_force_scale = scale_forces(base, a.model);
  a.model.scale_sd = own_scale_sd;
  a.model.name = fmt::format("{} adapted to {}", base.name, who);
  a.model.provenance =
      fmt::format("genio adapt: {} by {}; base: {}", base.name, who, base.provenance);
  if (a.min_jacobian < least_corner_ratio)
    a.message = fmt::format(
        "the elements cannot follow: the smallest ratio of corner Jacobians is {:.3f}; expected "
        "{:g} or more",
        a.min_jacobian, least_corner_ratio);
}

/// A path's last part, as it may stand in a model file.
std::string file_name(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  for (char& c : name)
    if (c == '"' || c == '\\' || (c >= 0 && c < ' ')) c = '_';
  return name;
}

}  // namespace

Adaptation adapt_model(const ModelDescription& base, const std::string& source,
                       const SpeakerOutline& given, const std::optional<SpeakerSurface>& surface) {
  check_mesh(base.mesh, source);
  check_outline_size(given);
  Adaptation a;
  a.outline = facing_model(given);
  check_outline(a.outline);
  const Similarity to_model = rigid_frame(a.outline, base);
  a.outline = moved_outline(a.outline, to_model);
  const ModelLine line = model_line(base, source);
  const PlaneRegistration plane = register_plane(base, line, a.outline);
  a.scale = plane.scale;
  const SolidRegistration solid = register_solid(base, line, plane, a.outline, plane.scale);
  a.distances = solid.distances, a.min_jacobian = solid.min_jacobian, a.repaired = solid.repaired;
  a.model = base;
  a.model.mesh = solid.mesh;
  std::string who = file_name(given.source);
  if (!given.speaker.empty()) who += ", speaker " + file_name(given.speaker);
  if (surface) {
    TriangleSurface there = surface->surface;
    for (Vec3& v : there.vertices) v = moved_place(a.outline, to_model, v);
    if (a.outline.mirrored)
      for (auto& t : there.triangles) std::swap(t[0], t[1]);
    const Polyline theirs(a.outline.tongue());
    const TongueLandmarks marks = tongue_landmarks(a.outline);
    LinePullOptions o;
    o.weight = solid_line_depth;
    const SurfaceRegistration r = register_surface(solid.mesh, there, [&](const Positions& x) {
      return line_pulls(line, line.nodes, x, theirs, plane.match, o);
    });
    a.model.mesh = r.mesh, a.min_jacobian = r.min_jacobian, a.surface_rms = r.rms;
    a.distances = line_distances(line, line.nodes, rest_positions(r.mesh), theirs, marks);
    who += " and " + file_name(surface->source);
  }
  carry_along(base, line, who, a);
  return a;
}

Adaptation adapt_to_surface(const ModelDescription& base, const std::string& source,
                            const SpeakerSurface& surface) {
  check_mesh(base.mesh, source);
  const ModelLine line = model_line(base, source);
  Adaptation a;
  a.model = base;
  const SurfaceRegistration r =
      register_surface(affinely_laid(base.mesh, surface.surface), surface.surface);
  a.model.mesh = r.mesh, a.min_jacobian = r.min_jacobian, a.surface_rms = r.rms;
  a.distances.rms = r.rms, a.distances.most = r.most;
  a.scale = std::cbrt(mesh_volume(r.mesh, rest_positions(r.mesh)) /
                      mesh_volume(base.mesh, rest_positions(base.mesh)));
  carry_along(base, line, file_name(surface.source), a);
  return a;
}

}  // namespace genio
