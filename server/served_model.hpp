#pragma once
// The models that a service answers with.

#include <memory>
#include <string>
#include <vector>

#include "forward/model/model.hpp"
#include "server/answer/answer_request.hpp"
#include "server/dispatch/dispatcher.hpp"
#include "server/workers/worker_side.hpp"

namespace genio {

/// A model that is ready to answer: its table of starting shapes is made.
struct ServedModel {
  ServedModel(ModelIdentity identity, Model model);
  ModelIdentity identity;
  std::unique_ptr<Model> model;
  std::unique_ptr<RequestWorker> worker;
};

/// Reads models from "NAME=FOLDER", or "FOLDER" for one under the name that its file has. Throws
/// InputError where a file cannot be read, or two have the same name.
std::vector<ServedModel> read_served_models(const std::vector<std::string>& options);

std::vector<ModelIdentity> identities(const std::vector<ServedModel>& models);

/// What a worker process does with an assignment. `memory_mb`: that it may take, see WorkerLimits.
/// For Nursery.
std::function<void(int socket)> worker_of(std::vector<ServedModel>& models, double memory_mb);

}  // namespace genio
