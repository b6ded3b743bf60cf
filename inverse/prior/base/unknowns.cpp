#include "inverse/prior/base/unknowns.hpp"

#include <algorithm>

namespace genio {

std::vector<Unknown> muscle_unknowns(const Model& model, bool bilateral) {
  std::vector<Unknown> unknowns;
  for (const auto& muscle : model.muscles) {
    const std::string name = bilateral ? bilateral_name(muscle.name) : muscle.name;
    if (std::any_of(unknowns.begin(), unknowns.end(),
                    [&](const auto& c) { return c.name == name; }))
      continue;
    Unknown c{name, 0, command_parameters(model, name), {}};
    for (int k : c.parameters) c.scale += model.parameters[k].info.upper;
    for (int k : c.parameters) c.shares.push_back(model.parameters[k].info.upper / c.scale);
    unknowns.push_back(std::move(c));
  }
  return unknowns;
}

std::vector<Eigen::Index> other_sides(const std::vector<Unknown>& unknowns) {
  std::vector<Eigen::Index> other(unknowns.size(), -1);
  for (size_t a = 0; a < unknowns.size(); ++a)
    for (size_t b = 0; b < unknowns.size(); ++b)
      if (a != b && unknowns[a].kind == Unknown::Kind::muscle &&
          unknowns[b].kind == Unknown::Kind::muscle &&
          bilateral_name(unknowns[a].name) == bilateral_name(unknowns[b].name))
        other[a] = Eigen::Index(b);
  return other;
}

std::vector<int> parameters_named(const Model& model, const std::string& name) {
  std::vector<int> result;
  for (size_t k = 0; k < model.parameters.size(); ++k)
    if (const std::string known = model.parameters[k].name.text();
        known == name || (known != bilateral_name(known) && bilateral_name(known) == name))
      result.push_back(int(k));
  return result.empty() ? std::vector{parameter_index(model, name)} : result;
}

Matrix pose_derivative(const std::vector<Unknown>& unknowns) {
  Matrix d = Matrix::Zero(3, Eigen::Index(unknowns.size()));
  for (size_t c = 0; c < unknowns.size(); ++c)
    if (unknowns[c].kind == Unknown::Kind::pose)
      d(Eigen::Index(unknowns[c].axis), Eigen::Index(c)) = unknowns[c].scale;
  return d;
}

HeadPose head_pose(const std::vector<Unknown>& unknowns, const Vector& z) {
  const Vec3 pose = pose_derivative(unknowns) * z;
  return {pose.head<2>(), pose[2]};
}

Parameters apply_unknowns(const std::vector<Unknown>& unknowns, const Vector& activations,
                          Parameters parameters) {
  for (size_t c = 0; c < unknowns.size(); ++c)
    for (size_t i = 0; i < unknowns[c].parameters.size(); ++i)
      parameters[unknowns[c].parameters[i]] =
          unknowns[c].value(activations[Eigen::Index(c)]) * unknowns[c].shares[i];
  return parameters;
}

}  // namespace genio
