#pragma once
// The conditions under one model: what is fitted together.

#include <memory>
#include <string>
#include <vector>

#include "discrepancy/conditions/observations.hpp"
#include "inverse/search/infer_workspace.hpp"

namespace genio {

/// Models of a description under what is known of each condition; equal ones are shared.
class ConditionSet {
 public:
  /// `members`: indices of conditions. The observations must outlive the set.
  ConditionSet(ModelDescription description, const Observations& observations,
               std::vector<size_t> members);

  size_t size() const { return members_.size(); }
  const std::vector<size_t>& members() const { return members_; }
  const ModelDescription& description() const { return description_; }
  const Observations& observations() const { return observations_; }
  const Condition& condition(size_t k) const { return observations_.conditions[members_[k]]; }
  const Model& model(size_t k) const { return *tongues_[tongue_[k]]->model; }
  Workspace& workspace(size_t k) { return infer_workspace(k).whole().workspace; }
  InferWorkspace& infer_workspace(size_t k) { return tongues_[tongue_[k]]->workspace; }
  /// What is believed of its commands.
  Prior prior(size_t k) const;
  /// True where its commands drive both sides alike.
  bool bilateral(size_t k) const;

 private:
  struct Tongue {
    explicit Tongue(std::unique_ptr<const Model> m) : model(std::move(m)), workspace(*model) {}
    std::unique_ptr<const Model> model;
    InferWorkspace workspace;
  };

  ModelDescription description_;
  const Observations& observations_;
  std::vector<size_t> members_, tongue_;
  std::vector<std::unique_ptr<Tongue>> tongues_;
};

/// A description under known effects.
ModelDescription with_effects(ModelDescription description,
                              const std::map<std::string, double>& effects);

/// Indices of the conditions to fit, or of those held out.
std::vector<size_t> fitted_conditions(const Observations& observations);
std::vector<size_t> heldout_conditions(const Observations& observations);

}  // namespace genio
