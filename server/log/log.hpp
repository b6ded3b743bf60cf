#pragma once
// What a service says while it runs.

#include <unistd.h>

#include <chrono>
#include <memory>
#include <thread>

#include "server/log/log_line.hpp"

namespace genio {

/// What is written and kept at most. Tests use smaller ones.
struct LogLimits {
  int a_second = 50;      ///< lines of a kind; a line tells how many were left out
  size_t waiting = 1000;  ///< lines that are not written yet
  size_t waiting_bytes = 1 << 20;
  std::chrono::milliseconds last{1000};  ///< that the end waits for what is not written yet
};

/// Writes events as lines, from a thread of its own. Nobody who tells an event ever waits for the
/// other side, nor sees an error of it: what cannot be written is left out and counted. A process
/// that is forked off tells nothing here; it makes a log of its own.
class Log {
 public:
  /// Throws std::system_error when the system has no thread left.
  explicit Log(LogForm form, int descriptor = STDERR_FILENO, const LogLimits& limits = {});
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  /// May be called from any thread.
  void write(const LogEvent& event) noexcept;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
  std::thread writer_;
};

}  // namespace genio
