#pragma once
// Answers shape requests over LCM.

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "forward/model/model.hpp"
#include "server/wire.hpp"

namespace genio {

struct ServiceOptions {
  std::string url;        ///< as choose_url gives it
  int queue = 256;        ///< requests that may wait; more are refused with a reply
  int remembered = 4096;  ///< replies kept for repeated ids
  std::function<void(const std::string& line)> log;
};

/// Answer to one request: validates, builds the target, infers. Never throws: what is wrong with
/// the request becomes a reply with status `failed`. `progress` and `cancelled` may be empty.
command_reply_t answer_request(const Model& model, const shape_request_t& request,
                               class RequestWorker& worker,
                               const std::function<void(int, double)>& progress,
                               const std::function<bool()>& cancelled);

/// Scratch of one worker.
class RequestWorker {
 public:
  explicit RequestWorker(const Model& model);
  ~RequestWorker();
  struct State;
  State& state() { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// Serves until `stop` becomes true. One thread owns the LCM connection, one computes (Ipopt with
/// MUMPS is not thread-safe). Every request gets a reply; a repeated id gets the reply of the
/// first, computed once.
void serve(const Model& model, const ServiceOptions& options, const std::atomic<bool>& stop);

}  // namespace genio
