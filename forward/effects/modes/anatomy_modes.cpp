#include "forward/effects/modes/anatomy_modes.hpp"

#include <fmt/format.h>

#include "forward/effects/modes/moved_rest.hpp"

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
  const auto& modes = draw.tongue.modes;
  const std::string name = modes[draw.random() % modes.size()].name;
  const double side = draw.random() % 2 == 0 ? 1 : -1;
  EffectChange change = change_by_number(
      "anatomy", {.key = name, .absent = 0, .unit = side, .first = 0.5, .most = 3});
  change.where = name;
  return change;
}

}  // namespace

EffectKind anatomy_kind() {
  return {.name = "anatomy",
          .make = make_modes,
          .external = true,
          .belief = {.parameters = {{.typical = 1}}},
          .sample = {{"size", 0.4}},
          .hidden = hidden_mode};
}

}  // namespace genio
