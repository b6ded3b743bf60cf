#include "forward/effects/modes/anatomy_modes.hpp"

#include <fmt/format.h>

#include <cmath>

namespace genio {
namespace {

constexpr double farthest_speaker = 3;  // [sd]

Effect make_modes(Settings& s, const Anatomy& a) {
  const ModelDescription& d = a.description;
  if (d.modes.empty())
    throw InputError(fmt::format(
        "{}: [effect.anatomy] needs modes: arrays 'anatomy_NAME' of the mesh's points", a.source));
  check_modes(d, a.source);
  std::vector<ParameterInfo> info;
  for (const AnatomyMode& mode : d.modes)
    info.push_back({.name = mode.name,
                    .unit = "sd",
                    .value = s.take(mode.name, 0),
                    .lower = -farthest_speaker,
                    .upper = farthest_speaker});
  return {.modes = std::make_shared<AnatomyModes>(std::move(info))};
}

/// A speaker who differs along one of the modes, to either side.
EffectChange hidden_mode(const ChangeDraw& draw) {
  const auto with = [](ModelDescription d) {
    if (!d.modes.empty()) return d;
    const auto plain = plain_modes(d);
    return with_modes(std::move(d), plain);
  };
  const auto modes = with(draw.tongue).modes;
  const std::string name = modes[draw.random() % modes.size()].name;
  const double side = draw.random() % 2 == 0 ? 1 : -1;
  const auto table = [=](double s) { return EffectTable{{name, s * side}}; };
  return {.effect = "anatomy",
          .where = modes.size() > 1 ? name : "",
          .first = 0.5,
          .most = 3,
          .truth =
              [=](ModelDescription d, double s) {
                d = with(std::move(d));
                d.effects["anatomy"][name] = s * side;
                return d;
              },
          .shipped = [=](ModelDescription d, double) { return with(std::move(d)); },
          .parameters = table};
}

}  // namespace

std::vector<NamedField> plain_modes(const ModelDescription& d) {
  constexpr double larger = 0.05, deeper = 3e-3, width = 0.012;  // of a length; [m]
  Vec3 jaw = Vec3::Zero();
  int count = 0;
  for (size_t a = 0; a < d.supports.size(); ++a)
    if (d.supports[a] == Support::fixed) jaw += d.mesh.nodes[a], ++count;
  jaw /= std::max(1, count), jaw[1] = 0;
  const double middle =
      0.5 * (d.mesh.nodes[size_t(d.landmarks.tip)][0] + d.mesh.nodes[size_t(d.landmarks.root)][0]);
  return {{"size", [=](const Vec3& x) -> Vec3 { return larger * (x - jaw); }},
          {"pharynx", [=](const Vec3& x) -> Vec3 {
             return 0.5 * deeper * (1 + std::tanh((x[0] - middle) / width)) * Vec3::UnitX();
           }}};
}

EffectKind anatomy_kind() {
  return {.name = "anatomy",
          .make = make_modes,
          .external = true,
          .belief = {.parameters = {{.typical = 1}}},
          .hidden = hidden_mode};
}

}  // namespace genio
