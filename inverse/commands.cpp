#include "inverse/commands.hpp"

#include <algorithm>

namespace genio {

std::vector<Command> muscle_commands(const Model& model, bool bilateral) {
  std::vector<Command> commands;
  for (const auto& muscle : model.muscles) {
    const std::string name = bilateral ? bilateral_name(muscle.name) : muscle.name;
    if (std::any_of(commands.begin(), commands.end(),
                    [&](const auto& c) { return c.name == name; }))
      continue;
    Command c{name, 0, command_parameters(model, name), {}};
    for (int k : c.parameters) c.scale += model.parameters[k].info.upper;
    for (int k : c.parameters) c.shares.push_back(model.parameters[k].info.upper / c.scale);
    commands.push_back(std::move(c));
  }
  return commands;
}

std::vector<int> parameters_named(const Model& model, const std::string& name) {
  std::vector<int> result;
  for (size_t k = 0; k < model.parameters.size(); ++k)
    if (const auto& known = model.parameters[k].name;
        known == name || (known != bilateral_name(known) && bilateral_name(known) == name))
      result.push_back(int(k));
  return result.empty() ? std::vector{parameter_index(model, name)} : result;
}

Matrix pose_derivative(const std::vector<Command>& commands) {
  Matrix d = Matrix::Zero(3, Eigen::Index(commands.size()));
  for (size_t c = 0; c < commands.size(); ++c)
    if (commands[c].kind == Command::Kind::pose)
      d(commands[c].name == "head_pose.x"   ? 0
        : commands[c].name == "head_pose.z" ? 1
                                            : 2,
        Eigen::Index(c)) = commands[c].scale;
  return d;
}

HeadPose head_pose(const std::vector<Command>& commands, const Vector& z) {
  const Vec3 pose = pose_derivative(commands) * z;
  return {pose.head<2>(), pose[2]};
}

Parameters apply_commands(const std::vector<Command>& commands, const Vector& activations,
                          Parameters parameters) {
  for (size_t c = 0; c < commands.size(); ++c)
    for (size_t i = 0; i < commands[c].parameters.size(); ++i)
      parameters[commands[c].parameters[i]] =
          commands[c].value(activations[Eigen::Index(c)]) * commands[c].shares[i];
  return parameters;
}

}  // namespace genio
