#include "forward/effects/surroundings/contact_kinds.hpp"

#include <fmt/format.h>

#include "forward/effects/bones/jaw_opening.hpp"
#include "forward/effects/surroundings/contact.hpp"
#include "forward/effects/surroundings/contact_damping.hpp"

namespace genio {
namespace {

/// With the surface of a bone ("palate").
Effect contact(Settings& s, const Anatomy& a, const std::string& bone,
               std::optional<TriangleSurface> ModelDescription::*of,
               std::vector<Vec3> AnatomyMode::*moving, const std::optional<Vec3>& hinge = {}) {
  const ModelDescription& d = a.description;
  const auto& surface = d.*of;
  const std::string name = bone + "_contact";
  if (!surface)
    throw InputError(
        fmt::format("{}: [effect.{}] needs a surface '{}' in [surfaces]", a.source, name, bone));
  const double stiffness = s.take("stiffness", 2e8), damping = s.take("damping", 0);
  const ModelDescription& standing = a.standing ? *a.standing : d;
  auto faces = contact_faces(*(standing.*of), standing.mesh, a.supports);
  if (a.standing) faces = moved_faces(*faces, *surface, d.mesh);
  const auto placed = std::make_shared<const ContactSurface>(ContactSurface{faces, hinge});
  const auto touch = std::make_shared<Contact>(name, placed, stiffness, moving);
  return {.potential = touch,
          .dissipation = std::make_shared<ContactDamping>(name, placed, damping),
          .contact = touch};
}

/// A bone that touches; the nearer it lies the more it does. Its place is known to the model.
EffectChange nearer_bone(const std::string& name,
                         std::optional<TriangleSurface> ModelDescription::*bone,
                         const Vec3& nearer) {
  const auto moved = [=](ModelDescription d, double s) {
    for (Vec3& v : (d.*bone)->vertices) v += 1e-3 * s * nearer;
    return d;
  };
  return {.effect = name,
          .first = 4,
          .most = 12,
          .truth =
              [=](ModelDescription d, double s) {
                d = moved(std::move(d), s);
                d.effects[name] = {{"stiffness", 2e8}};
                return d;
              },
          .shipped =
              [=](ModelDescription d, double s) {
                d = moved(std::move(d), s);
                d.effects.erase(name);
                return d;
              },
          .parameters = [](double) { return EffectTable{}; }};
}

Belief there_or_not() { return {.parameters = {{.parameter = "stiffness", .typical = 2e8}}}; }

}  // namespace

EffectKind palate_contact_kind() {
  return {.name = "palate_contact",
          .make =
              [](Settings& s, const Anatomy& a) {
                return contact(s, a, "palate", &ModelDescription::palate, &AnatomyMode::palate);
              },
          .external = true,
          .belief = there_or_not(),
          .sample = {{"stiffness", 1e7}, {"damping", 8}},
          .hidden =
              [](const ChangeDraw&) {
                return nearer_bone("palate_contact", &ModelDescription::palate, {0, 0, -1});
              }};
}

EffectKind jaw_contact_kind() {
  return {.name = "jaw_contact",
          .make =
              [](Settings& s, const Anatomy& a) {
                return contact(s, a, "jaw", &ModelDescription::jaw, &AnatomyMode::jaw,
                               opening_hinge(a));
              },
          .external = true,
          .belief = there_or_not(),
          .sample = {{"stiffness", 2e7}, {"damping", 5}},
          .hidden =
              [](const ChangeDraw&) {
                return nearer_bone("jaw_contact", &ModelDescription::jaw, {1, 0, 0});
              }};
}

}  // namespace genio
