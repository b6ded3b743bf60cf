#include "inverse/prior/base/prior_rows.hpp"

#include <fmt/format.h>

#include <cmath>

#include "forward/base/nearest_name.hpp"

namespace genio {
namespace {

std::vector<std::string> names(const std::vector<Unknown>& unknowns) {
  std::vector<std::string> result;
  for (const Unknown& u : unknowns) {
    result.push_back(u.name);
    if (const auto both = bilateral_name(u.name); both != u.name) result.push_back(both);
  }
  return result;
}

}  // namespace

PriorRows::PriorRows(const std::vector<Unknown>& unknowns)
    : lower_(Eigen::Index(unknowns.size())),
      upper_(Eigen::Index(unknowns.size())),
      effort_(Vector::Zero(Eigen::Index(unknowns.size()))),
      slab_(effort_),
      alone_(unknowns.size(), false) {
  for (size_t i = 0; i < unknowns.size(); ++i)
    lower_[Eigen::Index(i)] = unknowns[i].lower, upper_[Eigen::Index(i)] = unknowns[i].upper;
}

void PriorRows::add(const Vector& weights, double value, double sd) {
  rows_.push_back(weights / sd), values_.push_back(value / sd);
}

void PriorRows::add(Eigen::Index i, double value, double sd) {
  add(Vector::Unit(lower_.size(), i), value, sd);
  alone_[size_t(i)] = true;
}

PriorTerms PriorRows::terms() const {
  PriorTerms terms{Matrix(Eigen::Index(rows_.size()), lower_.size()),
                   Eigen::Map<const Vector>(values_.data(), Eigen::Index(values_.size())),
                   lower_,
                   upper_,
                   effort_,
                   slab_};
  for (size_t k = 0; k < rows_.size(); ++k) terms.rows.row(Eigen::Index(k)) = rows_[k].transpose();
  return terms;
}

std::vector<Eigen::Index> muscles_named(const std::vector<Unknown>& unknowns,
                                        const std::string& name, const char* who) {
  std::vector<Eigen::Index> result;
  for (size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].kind == Unknown::Kind::muscle &&
        (unknowns[i].name == name || bilateral_name(unknowns[i].name) == name))
      result.push_back(Eigen::Index(i));
  if (result.empty())
    throw InputError(fmt::format("{} {}: no such muscle among the unknowns; did you mean {}?", who,
                                 name, nearest_name(name, names(unknowns))));
  return result;
}

void need_positive(double sd, const char* what) {
  if (!(sd > 0) || !std::isfinite(sd))
    throw InputError(fmt::format("{}: standard deviation {}; expected a number above 0", what, sd));
}

}  // namespace genio
