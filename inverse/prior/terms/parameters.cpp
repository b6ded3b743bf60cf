#include "inverse/prior/terms/parameters.hpp"

#include "inverse/prior/base/read_normal.hpp"

namespace genio {
namespace {

constexpr double parameter_range = 20;  // standard deviations that a parameter may reach

Unknown unknown(const Model& model, const std::string& name, const ParameterPrior& belief) {
  need_positive(belief.sd, name.c_str());
  const std::vector<int> which = parameters_named(model, name);
  const auto& info = model.parameters[size_t(which.front())].info;
  const double lower = std::max(info.lower, belief.lower);
  const double upper = std::min(info.upper, belief.upper);
  if (!(belief.mean >= lower && belief.mean <= upper))
    throw InputError(fmt::format("parameter {}: mean {} {}; expected {} to {}", name, belief.mean,
                                 info.unit, lower, upper));
  if (belief.ratio && !(lower > 0)) throw std::invalid_argument(name + " has no logarithm");
  Unknown u{.name = name,
            .scale = 1,
            .parameters = which,
            .shares = std::vector<double>(which.size(), 1.0),
            .kind = Unknown::Kind::parameter,
            .unit = info.unit,
            .ratio = belief.ratio,
            .parameter = ParameterName::parse(name)};
  const double least = u.z_of(lower), most = u.z_of(upper), mean = u.z_of(belief.mean);
  // Bounds may be far beyond what is believed; the unit is what may be reached.
  u.scale = std::min(std::max(std::abs(least), std::abs(most)),
                     std::abs(mean) + parameter_range * belief.sd);
  u.lower = std::max(-1.0, least / u.scale), u.upper = std::min(1.0, most / u.scale);
  return u;
}

}  // namespace

std::vector<Unknown> ParametersTerm::unknowns(const Model& model) const {
  std::vector<Unknown> result;
  for (const auto& [name, belief] : parameters) result.push_back(unknown(model, name, belief));
  return result;
}

void ParametersTerm::add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const {
  for (size_t i = 0; i < unknowns.size(); ++i) {
    const Unknown& u = unknowns[i];
    if (u.kind != Unknown::Kind::parameter) continue;
    const ParameterPrior& belief = parameters.at(u.name);
    rows.add(Eigen::Index(i), u.z_of(belief.mean), belief.sd / u.scale);
  }
}

ParametersTerm ParametersTerm::read(const TomlReader& file) {
  ParametersTerm term;
  if (file.root().get("parameter"))
    for (const auto& [key, belief] : file.table(file.root(), "parameter")) {
      const std::string name(key.str());
      term.parameters[name] = {read_normal(file, belief, name)};
    }
  return term;
}

}  // namespace genio
