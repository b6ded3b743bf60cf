#include "speaker/modes/mode_fields.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <memory>

#include "speaker/adaptation/outline_of_model.hpp"
#include "speaker/outline/rigid_frame.hpp"
#include "speaker/outline/thin_plate.hpp"

namespace genio {
namespace {

constexpr double outline_spacing = 1e-3;  // [m]
constexpr double bending = 1e-4;          // weight against the distances of the splines' pairs

double radius(const std::vector<Vec2>& places) {
  Vec2 middle = Vec2::Zero();
  for (const Vec2& p : places) middle += p / double(places.size());
  double square = 0;
  for (const Vec2& p : places) square += (p - middle).squaredNorm();
  return std::sqrt(square / double(places.size()));
}

}  // namespace

std::vector<NamedField> mode_fields(const OutlineModes& modes, const ModelDescription& model,
                                    const std::string& source) {
  SpeakerOutline outline = outline_of_model(
      model, [](const Vec2& p) { return p; }, outline_spacing);
  outline.source = source;
  const OutlinePoints own = outline_points(outline);
  std::vector<Vec2> mean, ours;
  std::vector<Eigen::Index> which;
  for (size_t i = 0; i < own.places.size(); ++i)
    if (own.known[i])
      mean.push_back(modes.mean.segment<2>(2 * Eigen::Index(i))), ours.push_back(own.places[i]),
          which.push_back(Eigen::Index(i));
  const Eigen::Matrix2d turn =
      radius(ours) / radius(mean) *
      Eigen::Rotation2Dd(rigid_motion(mean, ours).angle).toRotationMatrix();
  std::vector<NamedField> fields;
  for (Eigen::Index k = 0; k < modes.named(); ++k) {
    std::vector<PlacePair> pairs;
    for (size_t i = 0; i < ours.size(); ++i)
      pairs.push_back({ours[i], ours[i] + turn * modes.modes.col(k).segment<2>(2 * which[i])});
    const auto map = std::make_shared<const ThinPlateMap>(pairs, bending);
    // Of lengths on average, by the affine map nearest to the pairs.
    const double wider = 0.5 * (affine_map(pairs).derivative(ours.front()).trace() - 2);
    fields.push_back({modes.names[size_t(k)], [map, wider](const Vec3& x) -> Vec3 {
                        const Vec2 p(x[0], x[2]), to = (*map)(p);
                        return {to[0] - p[0], wider * x[1], to[1] - p[1]};
                      }});
  }
  return fields;
}

}  // namespace genio
