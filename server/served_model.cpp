#include "server/served_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "runs/results/content_hash.hpp"
#include "server/dispatch/replies.hpp"

namespace genio {
namespace {

void answer_assignment(std::vector<ServedModel>& models, const Assignment& assignment,
                       WorkerPipe& pipe) {
  std::string why;
  const auto request =
      decode_checked<shape_request_t>(assignment.request.data(), assignment.request.size(), why);
  ServedModel& served = models.at(assignment.model);
  RequestHooks hooks;
  hooks.progress = [&](int iteration, double rms) { pipe.tell_progress(iteration, 1e3 * rms); };
  hooks.improved = [&](const command_reply_t& so_far) { pipe.tell_improved(so_far); };
  hooks.cancelled = [&] { return pipe.withdrawn(); };
  const RequestAnswer answer =
      answer_request(*served.model, request.value(), assignment.deadline_s, *served.worker, hooks,
                     stream_state(assignment.start));
  pipe.tell_answer(answer.reply, state_bytes(answer.state));
}

}  // namespace

ServedModel::ServedModel(ModelIdentity i, Model m)
    : identity(std::move(i)),
      model(std::make_unique<Model>(std::move(m))),
      worker(std::make_unique<RequestWorker>(*model)) {}

std::vector<ServedModel> read_served_models(const std::vector<std::string>& options) {
  std::vector<ServedModel> models;
  for (const std::string& option : options) {
    const size_t equals = option.find('=');
    const std::string path = option.substr(equals == std::string::npos ? 0 : equals + 1);
    Model model = read_model(path);
    const std::string name = equals == std::string::npos ? model.name : option.substr(0, equals);
    if (name.empty()) throw InputError("--model " + option + ": the name before '=' is empty");
    if (std::any_of(models.begin(), models.end(),
                    [&](const ServedModel& m) { return m.identity.name == name; }))
      throw InputError(fmt::format(
          "--model {}: another model has the name '{}'; give it one by NAME=FOLDER", option, name));
    models.emplace_back(ModelIdentity{name, content_hash(path)}, std::move(model));
  }
  return models;
}

std::vector<ModelIdentity> identities(const std::vector<ServedModel>& models) {
  std::vector<ModelIdentity> all;
  for (const ServedModel& m : models) all.push_back(m.identity);
  return all;
}

std::function<void(int)> worker_of(std::vector<ServedModel>& models, double memory_mb) {
  return [&models, memory_mb](int socket) {
    limit_memory(memory_mb);
    run_worker(
        socket,
        [&](const Assignment& assignment, WorkerPipe& pipe) {
          answer_assignment(models, assignment, pipe);
        },
        [&](const WorkerPipe& pipe) {
          for (ServedModel& m : models) m.worker->prepare([&] { return pipe.called(); });
        });
  };
}

}  // namespace genio
