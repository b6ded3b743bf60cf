#include "inverse/prior/terms/head_pose_prior.hpp"

#include "inverse/prior/base/read_normal.hpp"

namespace genio {
namespace {

constexpr double pose_range = 4;  // standard deviations that a head pose may reach

Unknown unknown(const char* part, PoseAxis axis, double sd, const char* unit) {
  const ParameterName name{"head_pose", part};
  return {.name = name.text(),
          .scale = pose_range * sd,
          .parameters = {},
          .shares = {},
          .kind = Unknown::Kind::pose,
          .unit = unit,
          .lower = -1,
          .upper = 1,
          .axis = axis,
          .parameter = name};
}

}  // namespace

std::vector<Unknown> HeadPoseTerm::unknowns(const Model&) const {
  if (!head_pose) return {};
  need_positive(head_pose->shift_sd, "head_pose shift");
  need_positive(head_pose->turn_sd, "head_pose turn");
  return {unknown("x", PoseAxis::x, head_pose->shift_sd, "m"),
          unknown("z", PoseAxis::z, head_pose->shift_sd, "m"),
          unknown("turn", PoseAxis::turn, head_pose->turn_sd, "rad")};
}

void HeadPoseTerm::add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const {
  for (size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].kind == Unknown::Kind::pose) rows.add(Eigen::Index(i), 0, 1 / pose_range);
}

HeadPoseTerm HeadPoseTerm::read(const TomlReader& file) {
  if (!file.root().get("head_pose")) return {};
  const toml::table& pose = file.table(file.root(), "head_pose");
  file.only(pose, {"shift_sd_mm", "turn_sd_deg"});
  return {HeadPosePrior{1e-3 * positive(file, pose, "shift_sd_mm", 1),
                        M_PI / 180 * positive(file, pose, "turn_sd_deg", 2)}};
}

}  // namespace genio
