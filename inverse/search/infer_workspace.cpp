#include "inverse/search/infer_workspace.hpp"

#include <stdexcept>

namespace genio {

void InferWorkspace::check(const Model& model) const {
  if (model.pattern != model_->pattern)  // which copies share
    throw std::invalid_argument(model.name + ": the workspace was made for another model");
}

TongueState& InferWorkspace::whole() {
  if (!whole_) whole_.emplace(*model_);
  return *whole_;
}

TongueState* InferWorkspace::half(const Prior& prior) {
  std::vector<std::string> names;
  for (const auto& [name, belief] : prior.parameters) names.push_back(name);
  if (!asked_ || *asked_ != names) {
    half_.reset();
    mirror_ = mirror_of(*model_, names);
    asked_ = std::move(names);
    if (mirror_) half_.emplace(mirror_->half);
  }
  return half_ ? &*half_ : nullptr;
}

}  // namespace genio
