#include "inverse/target/target.hpp"

#include <cmath>

namespace genio {

Vec3 FleshPoint::on(const Positions& x) const {
  Vec3 place = Vec3::Zero();
  for (const auto& [node, share] : at) place += share * node_position(x, node);
  return place;
}

bool Target::midsagittal() const {
  if (!surface.empty()) return false;
  for (const auto& f : flesh)
    if (!std::isnan(f.position[1]) && std::abs(f.position[1]) > 1e-6) return false;
  return true;
}

Vec2 Target::middle() const {
  Vec2 sum = Vec2::Zero();
  for (const auto& p : curve) sum += p.position;
  for (const auto& p : flesh) sum += Vec2(p.position[0], p.position[2]);
  for (const auto& p : surface) sum += Vec2(p.position[0], p.position[2]);
  const size_t count = curve.size() + flesh.size() + surface.size();
  return sum / double(std::max<size_t>(1, count));
}

Target curve_target(const Model& model, const Positions& x, int count, double sigma) {
  Target t;
  for (const Vec2& q : TongueLine(model).sample(x, count)) t.curve.push_back({q, sigma});
  return t;
}

}  // namespace genio
