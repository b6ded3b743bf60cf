#pragma once
// The answer to one request, without any transport.

#include <functional>
#include <memory>

#include "forward/model/model.hpp"
#include "server/wire.hpp"

namespace genio {

/// Scratch of one worker, with the atlas made: no request should wait for it.
class RequestWorker {
 public:
  explicit RequestWorker(const Model& model);
  ~RequestWorker();
  struct State;
  State& state() { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// Validates, builds the target, infers. Never throws: what is wrong with the request becomes a
/// reply with status `failed`. `progress` (iteration, rms [m]) and `cancelled` may be empty.
command_reply_t answer_request(const Model& model, const shape_request_t& request,
                               RequestWorker& worker,
                               const std::function<void(int iteration, double rms)>& progress,
                               const std::function<bool()>& cancelled);

}  // namespace genio
