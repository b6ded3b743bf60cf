#pragma once
// What a worker process does between its requests.

#include <functional>

#include "forward/base/elapsed.hpp"
#include "server/dispatch/dispatcher.hpp"
#include "server/workers/frame_pipe.hpp"

namespace genio {

/// A worker's end of the pipe. When the service is gone the process ends.
class WorkerPipe {
 public:
  explicit WorkerPipe(int socket) : socket_(socket) {}

  /// Waits for the next request.
  Assignment wait();
  /// True where something has come, or comes within this time.
  bool called(int within_ms = 0) const;
  /// True once the request at hand was withdrawn. Looks without waiting, and now and then tells
  /// the service that the worker is alive.
  bool withdrawn();
  void tell_progress(int iteration, double rms_mm);
  void tell_improved(const command_reply_t& so_far);
  void tell_answer(const command_reply_t& reply, const std::vector<uint8_t>& state);

 private:
  void send(const WorkerMessage& message);
  void receive(int flags);

  int socket_;
  MessageAssembler assembler_;
  bool withdrawn_ = false;
  Stopwatch quiet_;  // since it last sent anything
};

/// Exit status of a worker that found no more memory.
inline constexpr int exit_without_memory = 77;

/// Bounds the address space to what is there now and `mb` more. A worker that finds no more ends by
/// exit_without_memory.
void limit_memory(double mb);

/// Answers what comes, with `answer`, until the service is gone. `idle` is called when
/// nothing came for a second, and should return soon once the pipe is called().
void run_worker(int socket, const std::function<void(const Assignment&, WorkerPipe&)>& answer,
                const std::function<void(const WorkerPipe&)>& idle = {});

}  // namespace genio
