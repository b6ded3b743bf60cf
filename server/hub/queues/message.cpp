#include "server/hub/queues/message.hpp"

#include <utility>

namespace genio {
namespace {

// What the allocator takes beside the bytes, so that tiny messages count as well.
constexpr size_t message_overhead = 128;

}  // namespace

HubMessage::HubMessage(std::vector<char> bytes, size_t& held)
    : bytes_(std::move(bytes)), held_(held) {
  held_ += cost();
}

HubMessage::~HubMessage() { held_ -= cost(); }

size_t HubMessage::cost() const { return bytes_.capacity() + message_overhead; }

}  // namespace genio
