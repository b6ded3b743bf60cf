#pragma once
// Messages between the service and its workers, over a stream of bytes.

#include <cstdint>
#include <optional>
#include <vector>

namespace genio {

/// What a message between service and worker says.
enum class WorkerWord : uint8_t {
  compute,   ///< to the worker: an Assignment
  withdraw,  ///< to the worker: end the work at hand
  alive,     ///< from the worker: it works on
  progress,  ///< iteration and misfit
  improved,  ///< the best reply so far
  answer,    ///< the reply, and the stream's state
};

struct WorkerMessage {
  WorkerWord word = WorkerWord::alive;
  std::vector<uint8_t> body = {};
};

/// Bytes of a message as they travel.
std::vector<uint8_t> packed(const WorkerMessage& message);

/// Puts messages together from the pieces in which they come.
class MessageAssembler {
 public:
  void add(const uint8_t* data, size_t size);
  /// The next whole message. Throws std::runtime_error where the bytes are none: the other side is
  /// broken.
  std::optional<WorkerMessage> next();

 private:
  std::vector<uint8_t> bytes_;
  size_t at_ = 0;
};

}  // namespace genio
