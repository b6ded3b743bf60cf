#pragma once
// What one worker keeps from inversion to inversion.

#include "inverse/search/atlas.hpp"
#include "inverse/search/symmetric_route.hpp"

namespace genio {

/// A model with the scratch of its solves and its atlas.
struct TongueState {
  explicit TongueState(const Model& m) : model(&m), workspace(m) {}

  const Model* model;
  Workspace workspace;
  AtlasCache atlas;
};

/// Whole and half tongue of one model, each made when it is first needed. One a thread. It keeps a
/// copy of the model, so that the model itself may go.
class InferWorkspace {
 public:
  explicit InferWorkspace(const Model& model) : model_(std::make_shared<const Model>(model)) {}
  /// Throws std::invalid_argument when it was made for another model.
  void check(const Model& model) const;

  TongueState& whole();
  /// nullptr where the model, or what the prior estimates along, is not symmetric.
  TongueState* half(const Prior& prior);
  /// Of half(); only after it gave one.
  const Mirror& mirror() const { return *mirror_; }

 private:
  std::shared_ptr<const Model> model_;
  std::optional<TongueState> whole_, half_;
  std::unique_ptr<const Mirror> mirror_;
  std::optional<std::vector<std::string>> asked_;  // the parameters that mirror_ is for
};

}  // namespace genio
