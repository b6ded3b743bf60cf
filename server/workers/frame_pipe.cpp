#include "server/workers/frame_pipe.hpp"

#include <cstring>
#include <stdexcept>

namespace genio {
namespace {

constexpr size_t head_bytes = 1 + sizeof(uint32_t);
constexpr size_t most_body = 64u << 20;

}  // namespace

std::vector<uint8_t> packed(const WorkerMessage& message) {
  const auto size = uint32_t(message.body.size());
  std::vector<uint8_t> bytes(head_bytes);
  bytes[0] = uint8_t(message.word);
  std::memcpy(bytes.data() + 1, &size, sizeof size);
  bytes.insert(bytes.end(), message.body.begin(), message.body.end());
  return bytes;
}

void MessageAssembler::add(const uint8_t* data, size_t size) {
  if (at_ > 0) bytes_.erase(bytes_.begin(), bytes_.begin() + std::ptrdiff_t(at_)), at_ = 0;
  bytes_.insert(bytes_.end(), data, data + size);
}

std::optional<WorkerMessage> MessageAssembler::next() {
  const size_t left = bytes_.size() - at_;
  if (left < head_bytes) return std::nullopt;
  uint32_t size = 0;
  std::memcpy(&size, bytes_.data() + at_ + 1, sizeof size);
  const uint8_t word = bytes_[at_];
  if (word > uint8_t(WorkerWord::answer) || size > most_body)
    throw std::runtime_error("a worker's message is none");
  if (left < head_bytes + size) return std::nullopt;
  const auto body = bytes_.begin() + std::ptrdiff_t(at_ + head_bytes);
  at_ += head_bytes + size;
  return WorkerMessage{WorkerWord(word), {body, body + size}};
}

}  // namespace genio
