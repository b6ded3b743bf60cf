#include "forward/model/build_effects.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "forward/base/nearest_name.hpp"
#include "forward/effects/bones/hyoid_mobility.hpp"
#include "forward/effects/bones/jaw_opening.hpp"
#include "forward/effects/muscles/activation_dynamics.hpp"
#include "forward/effects/muscles/extra_muscle.hpp"
#include "forward/effects/muscles/force_length.hpp"
#include "forward/effects/muscles/force_velocity.hpp"
#include "forward/effects/muscles/muscles.hpp"
#include "forward/effects/muscles/weak_muscle.hpp"
#include "forward/effects/surroundings/airway_pressure.hpp"
#include "forward/effects/surroundings/contact.hpp"
#include "forward/effects/surroundings/gravity.hpp"
#include "forward/effects/tissue/active_stiffening.hpp"
#include "forward/effects/tissue/compressibility.hpp"
#include "forward/effects/tissue/elasticity.hpp"
#include "forward/effects/tissue/fibre_anisotropy.hpp"
#include "forward/effects/tissue/material_nonlinearity.hpp"
#include "forward/effects/tissue/mucosa_layer.hpp"
#include "forward/effects/tissue/stiff_region.hpp"
#include "forward/effects/tissue/viscosity.hpp"
#include "forward/geometry/surface_field.hpp"
#include "forward/model/half_model.hpp"
#include "forward/model/places.hpp"
#include "forward/tissue/tongue_faces.hpp"

namespace genio {
namespace {

using Made = std::shared_ptr<const Effect>;
using Maker = Made (*)(Settings&, const Anatomy&);
using Places = std::vector<Place> (*)(const ModelDescription&);

struct EffectKind {
  std::string name;
  Maker maker;
  Places places = nullptr;  ///< where it may be, where that needs saying
};

constexpr double deepest_overlap = 2e-3;  // at rest [m]

std::vector<int> nodes_with(const Anatomy& a, Support support) {
  std::vector<int> nodes;
  for (size_t n = 0; n < a.supports.size(); ++n)
    if (a.supports[n] == support) nodes.push_back(int(n));
  return nodes;
}

/// Where the jaw turns, from the jaw_opening table when there is one.
Vec3 jaw_hinge(Settings& s) { return s.take_point("hinge_", JawMotion{}.hinge); }

Made contact(Settings& s, const Anatomy& a, const std::string& name,
             const std::optional<TriangleSurface>& surface) {
  const ModelDescription& d = a.description;
  if (!surface)
    throw InputError(fmt::format("{}: [effect.{}] needs a surface '{}' in [surfaces]", a.source,
                                 name, name.substr(0, name.find('_'))));
  const double stiffness = s.take("stiffness", 2e8), damping = s.take("damping", 0);
  const auto field = field_about(*surface, d.mesh);
  const auto area = nodal_areas(d.mesh, outer_faces(d.mesh, a.supports));
  std::vector<ContactNode> nodes;
  for (size_t n = 0; n < area.size(); ++n) {
    const double gap = field->value(d.mesh.nodes[n]);
    // Far behind the surface: another side of it (the floor of the mouth lies behind the pharynx).
    if (area[n] > 0 && moves_freely(a.supports[n]) && gap > -deepest_overlap)
      nodes.push_back({int(n), area[n], std::min(0.0, gap)});
  }
  std::optional<Vec3> hinge;
  if (const auto jaw = d.effects.find("jaw_opening");
      name == "jaw_contact" && jaw != d.effects.end()) {
    Settings opening(a.source, "jaw_opening", jaw->second);
    hinge = jaw_hinge(opening);
  }
  return std::make_shared<Contact>(name, field, std::move(nodes), stiffness, damping, hinge);
}

TissueConstants constants(Settings& s) {
  TissueConstants c;
  c.a10 = s.take("a10", c.a10);
  c.a20 = s.take("a20", c.a20);
  c.kappa = s.take("kappa", 1000 * c.a10);
  return c;
}

Made hyoid_mobility(Settings& s, const Anatomy& a) {
  auto nodes = nodes_with(a, Support::body);
  const auto of_half = nodes_with(a, Support::sagittal);
  if (nodes.empty() && of_half.empty())
    throw InputError(a.source + ": [effect.hyoid_mobility] needs nodes with support 2 (hyoid)");
  std::vector<double> shares(nodes.size(), 1.0);
  double whole = double(nodes.size());
  for (int n : of_half) {
    const bool middle = std::abs(a.description.mesh.nodes[size_t(n)][1]) < on_plane;
    nodes.push_back(n), shares.push_back(middle ? 0.5 : 1.0);
    whole += 2 * shares.back();
  }
  for (double& share : shares) share /= whole;
  const double compliance = s.take("compliance_z", 0), stiffness = s.take("stiffness_xy", 0);
  return std::make_shared<HyoidMobility>(std::move(nodes), std::move(shares),
                                         rest_positions(a.description.mesh), compliance, stiffness,
                                         s.take("mass", 0.01));
}

Made weak_muscle(Settings& s, const Anatomy& a) {
  std::vector<double> loss;
  for (const Muscle& m : a.muscles) {
    const std::string both = bilateral_name(m.name);
    const double shared = both == m.name ? 0.0 : s.take(both, 0);
    loss.push_back(s.take(m.name, shared));
  }
  return std::make_shared<WeakMuscle>(a.muscles, loss);
}

Made active_stiffening(Settings& s, const Anatomy& a) {
  const double factor = s.take("factor", 10), largest = s.take("largest", 0);
  if (largest != 0 && largest != 1)
    throw InputError(
        fmt::format("{}: [effect.active_stiffening] largest = {}; expected 0 (muscles "
                    "of an element add up) or 1 (the largest counts)",
                    a.source, largest));
  return std::make_shared<ActiveStiffening>(a.description.mesh, a.muscles, factor,
                                            largest == 1 ? Recruitment::largest : Recruitment::sum);
}

Made airway_pressure(Settings& s, const Anatomy& a) {
  const HexMesh& mesh = a.description.mesh;
  std::vector<Quad> faces;
  for (const Quad& f : free_faces(mesh, a.supports)) {
    const Vec3 normal = (mesh.nodes[size_t(f[2])] - mesh.nodes[size_t(f[0])])
                            .cross(mesh.nodes[size_t(f[3])] - mesh.nodes[size_t(f[1])]);
    if (normal.dot(Vec3(0.5, 0, 1)) > 0) faces.push_back(f);
  }
  return std::make_shared<AirwayPressure>(mesh, a.supports, std::move(faces),
                                          s.take("pressure", 0));
}

Vec3 centroid(const HexMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : mesh.nodes) sum += x;
  return sum / double(mesh.nodes.size());
}

/// Every effect there is; adding one here is all it takes, also to be a candidate for what a model
/// misses.
const std::vector<EffectKind>& kinds() {
  static const std::vector<EffectKind> all = {
      {"elasticity",
       [](Settings& s, const Anatomy& a) -> Made {
         return std::make_shared<Elasticity>(a.description.mesh, constants(s),
                                             a.description.effects.contains("viscosity"));
       }},
      {"muscles",
       [](Settings&, const Anatomy& a) -> Made { return std::make_shared<Muscles>(a.muscles); }},
      {"palate_contact",
       [](Settings& s, const Anatomy& a) {
         return contact(s, a, "palate_contact", a.description.palate);
       }},
      {"jaw_contact",
       [](Settings& s, const Anatomy& a) {
         return contact(s, a, "jaw_contact", a.description.jaw);
       }},
      {"gravity",
       [](Settings& s, const Anatomy& a) -> Made {
         const Vec3 g = s.take_point("", Vec3(0, 0, -9.81));
         return std::make_shared<Gravity>(a.mass, g, s.take("pitch", 0));
       }},
      {"active_stiffening", active_stiffening},
      {"fibre_anisotropy",
       [](Settings& s, const Anatomy& a) -> Made {
         return std::make_shared<FibreAnisotropy>(a.description.mesh, a.muscles,
                                                  s.take("modulus", 0));
       }},
      {"material_nonlinearity",
       [](Settings& s, const Anatomy& a) -> Made {
         const double a20 = s.take("a20", 0), a30 = s.take("a30", 0);
         const auto& own = a.description.effects.at("elasticity");
         const auto own_a20 = own.find("a20");
         return std::make_shared<MaterialNonlinearity>(
             a.description.mesh, a20, a30,
             own_a20 == own.end() ? TissueConstants{}.a20 : own_a20->second);
       }},
      {"compressibility",
       [](Settings& s, const Anatomy& a) -> Made {
         return std::make_shared<Compressibility>(a.description.mesh, s.take("compliance", 0));
       }},
      {"mucosa_layer",
       [](Settings& s, const Anatomy& a) -> Made {
         const double a10 = s.take("a10", 0), a20 = s.take("a20", 0),
                      thickness = s.take("thickness", 1e-3);
         return std::make_shared<MucosaLayer>(
             a.description.mesh, free_faces(a.description.mesh, a.supports), a10, a20, thickness);
       }},
      {"stiff_region",
       [](Settings& s, const Anatomy& a) -> Made {
         const double factor = s.take("factor", 1), radius = s.take("radius", 0.015);
         return std::make_shared<StiffRegion>(
             a.description.mesh, factor, s.take_point("", centroid(a.description.mesh)), radius,
             a.description.effects.contains("material_nonlinearity"));
       },
       regions},
      {"weak_muscle", weak_muscle},
      {"extra_muscle",
       [](Settings& s, const Anatomy& a) -> Made {
         const Vec3 from = s.take_point("from_", Vec3::Zero()),
                    to = s.take_point("to_", Vec3::Zero());
         const double radius = s.take("radius", 8e-3), force = s.take("force", 0);
         return std::make_shared<ExtraMuscle>(a.description.mesh, from, to, radius, force);
       },
       muscle_courses},
      {"force_length",
       [](Settings& s, const Anatomy& a) -> Made {
         const double strength = s.take("strength", 1), width = s.take("width", 0.67),
                      optimum = s.take("optimum", 1);
         return std::make_shared<ForceLength>(a.muscles, strength, width, optimum);
       }},
      {"force_velocity",
       [](Settings& s, const Anatomy& a) -> Made {
         const double strength = s.take("strength", 1), velocity = s.take("max_velocity", 10);
         return std::make_shared<ForceVelocity>(a.muscles, strength, velocity);
       }},
      {"activation_dynamics",
       [](Settings& s, const Anatomy&) -> Made {
         const double rise = s.take("rise", 0.015), fall = s.take("fall", 0.05);
         return std::make_shared<ActivationDynamics>(rise, fall);
       }},
      {"jaw_opening",
       [](Settings& s, const Anatomy& a) -> Made {
         const JawMotion motion{jaw_hinge(s), s.take("angle", 0), s.take("slide", 0)};
         return std::make_shared<JawOpening>(nodes_with(a, Support::led), a.description.mesh,
                                             motion);
       }},
      {"hyoid_mobility", hyoid_mobility},
      {"airway_pressure", airway_pressure},
      {"viscosity", [](Settings& s, const Anatomy& a) -> Made {
         const double alpha = s.take("alpha", 40), beta = s.take("beta", 0.03);
         return std::make_shared<Viscosity>(a.mass, alpha, beta);
       }}};
  return all;
}

}  // namespace

const std::vector<std::string>& effect_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> n;
    for (const EffectKind& kind : kinds()) n.push_back(kind.name);
    return n;
  }();
  return names;
}

std::vector<Place> places_of(const std::string& effect, const ModelDescription& d) {
  for (const EffectKind& kind : kinds())
    if (kind.name == effect && kind.places) return kind.places(d);
  return {{"", {}}};
}

std::vector<Support> supports_for(const ModelDescription& d) {
  std::vector<Support> supports = d.supports;
  for (Support& s : supports) {
    if (s == Support::fixed && d.effects.contains("jaw_opening")) s = Support::led;
    if (d.effects.contains("hyoid_mobility")) {
      if (s == Support::horizontal) s = Support::body;
      if (s == Support::forward) s = Support::sagittal;
    }
  }
  return supports;
}

std::shared_ptr<const Effect> make_effect(const std::string& name, const EffectTable& table,
                                          const Anatomy& anatomy) {
  const auto kind = std::find_if(kinds().begin(), kinds().end(),
                                 [&](const EffectKind& k) { return k.name == name; });
  if (kind == kinds().end())
    throw InputError(fmt::format("{}: [effect.{}] is no effect; did you mean {}?", anatomy.source,
                                 name, nearest_name(name, effect_names())));
  Settings settings(anatomy.source, name, table);
  const auto effect = kind->maker(settings, anatomy);
  settings.finish();
  for (const auto& info : effect->parameters())
    if (!(info.value >= info.lower && info.value <= info.upper))
      throw InputError(fmt::format("{}: [effect.{}] {} = {}; expected {} to {} {}", anatomy.source,
                                   name, info.name, info.value, info.lower, info.upper, info.unit));
  return effect;
}

}  // namespace genio
