#include "server/seal/key_refusals.hpp"

#include <algorithm>

#include "server/dispatch/admission.hpp"

namespace genio {
namespace {

constexpr const char* key_is_missing =
    "this server takes only requests that are sealed with its key; ask its owner for the key file "
    "and use --key";

}  // namespace

std::vector<OutgoingMessage> KeyRefusals::answer(const void* data, size_t size, int64_t now) {
  const auto sender = sender_of(data, size);
  if (!sender) return {};
  const double passed_s = 1e-6 * double(std::max<int64_t>(0, now - last_));
  left_ = std::min(double(limits_.answers), left_ + limits_.answers_per_s * passed_s);
  last_ = now;
  if (left_ < 1) return {};
  left_ -= 1;
  const std::string channel = "GENIO_REPLY." + sender->client;
  std::vector<OutgoingMessage> messages;
  for (auto& old : replies_of_earlier_versions(data, size, sender->id))
    messages.push_back({channel, std::move(old)});
  if (messages.empty()) {
    auto reply = reply_without_answer(sender->id, "refused", key_is_missing);
    reply.utime = now;
    messages.push_back({channel, encode(reply)});
  }
  return messages;
}

}  // namespace genio
