#pragma once
// The answer to one request, without any transport.

#include <functional>
#include <memory>

#include "forward/model/model.hpp"
#include "server/answer/stream_state.hpp"
#include "server/wire/wire.hpp"

namespace genio {

/// Scratch of one worker, with the atlas of midsagittal shapes made: no request should wait for it.
class RequestWorker {
 public:
  explicit RequestWorker(const Model& model);
  ~RequestWorker();
  /// Makes what registrations need, and then the atlas of other shapes, while there is nothing else
  /// to do: until `stop` says so. The atlas goes on where it stopped.
  void prepare(const std::function<bool()>& stop);
  struct State;
  State& state() { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// What is told and asked while an answer is computed; any of them may be empty.
struct RequestHooks {
  std::function<void(int iteration, double rms)> progress;  ///< rms [m]
  std::function<void(command_reply_t so_far)> improved;
  /// Asked before each step of every search, so that it may tell that the work goes on.
  std::function<bool()> cancelled;
};

struct RequestAnswer {
  command_reply_t reply;
  StreamState state;  ///< for the next frame of its stream
};

/// Builds the target and infers, from where the stream's last frame ended if that is known. What is
/// wrong with the points becomes a reply with status `failed`; see fault_of() for the other fields.
/// `deadline_s`: from now on; 0: none. Throws std::bad_alloc alone.
RequestAnswer answer_request(const Model& model, const shape_request_t& request, double deadline_s,
                             RequestWorker& worker, const RequestHooks& hooks = {},
                             const StreamState& start = {});

}  // namespace genio
