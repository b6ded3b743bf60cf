#include "bench/figures/service/questions.hpp"

#include <cmath>

#include "inverse/target/tongue_line.hpp"

namespace genio::bench {
namespace {

void add_point(shape_request_t& r, const Vec3& place, const char* kind) {
  ++r.point_count;
  r.x_mm.push_back(1e3 * place[0]), r.y_mm.push_back(0), r.z_mm.push_back(1e3 * place[2]);
  r.sigma_mm.push_back(1), r.kind.push_back(kind);
}

shape_request_t empty_question() {
  shape_request_t r{};
  r.bilateral = 1, r.time_s = std::nan("");
  return r;
}

}  // namespace

std::vector<shape_request_t> quick_questions(const Model& model, int count) {
  std::vector<shape_request_t> questions;
  const auto node = [&](int index) { return model.mesh.nodes[size_t(index)]; };
  for (int k = 0; k < count; ++k) {
    const double angle = 2.4 * k, way = 2e-3 * double(k) / count;
    shape_request_t r = empty_question();
    add_point(r, node(model.landmarks.dorsum) + way * Vec3(std::cos(angle), 0, std::sin(angle)),
              "dorsum");
    add_point(r, node(model.landmarks.tip) + way * Vec3(-std::cos(angle), 0, 0), "tip");
    questions.push_back(r);
  }
  return questions;
}

shape_request_t long_question(const Model& model) {
  shape_request_t r = empty_question();
  r.bilateral = 0, r.starts = 1000;
  const TongueLine line(model);
  for (const Vec2& p : line.sample(model.rest, 40))
    add_point(r, {p[0] + 1e-3, 0, p[1] + 2e-3}, "curve");
  return r;
}

bool same_answer(const command_reply_t& a, const command_reply_t& b) {
  if (a.status != b.status || a.verdict != b.verdict || a.force_N.size() != b.force_N.size())
    return false;
  for (size_t i = 0; i < a.force_N.size(); ++i)
    if (std::abs(a.force_N[i] - b.force_N[i]) > 1e-3) return false;
  return true;
}

}  // namespace genio::bench
