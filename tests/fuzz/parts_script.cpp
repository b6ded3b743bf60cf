#include "tests/fuzz/parts_script.hpp"

#include <array>

#include "forward/base/types.hpp"
#include "server/udpm/incoming_parts.hpp"
#include "tests/fuzz/fuzz_script.hpp"

namespace genio::test {
namespace {

using std::chrono::milliseconds;

constexpr size_t capacity = 20;  // bytes of a part

UdpmLimits few_parts() {
  UdpmLimits limits;
  limits.message_bytes = 300, limits.parts = 16;
  limits.unfinished_bytes = 2000, limits.unfinished_messages = 4, limits.finished_messages = 2;
  return limits;
}

WholeMessage sent_message(size_t number) {
  constexpr std::array<size_t, 4> sizes{1, 50, 100, 300};
  return {number % 2 ? "A" : "B", std::vector<uint8_t>(sizes[number], uint8_t(number))};
}

void spoil(part_t& part, FuzzScript& script) {
  switch (script.below(6)) {
    case 0:
      part.index = int32_t(script.byte()) - 100;
      break;
    case 1:
      part.count = int32_t(script.byte()) - 100;
      break;
    case 2:
      part.channel = std::string(script.byte(), 'A');
      break;
    case 3:
      part.message[script.below(part.message.size())] = char(script.byte());
      break;
    case 4:
      part.data.resize(script.byte(), 7), part.size = int32_t(part.data.size());
      break;
    default:
      if (!part.data.empty()) part.data[script.below(part.data.size())] ^= 1;
      break;
  }
}

}  // namespace

void play_parts_script(const std::string& bytes) {
  FuzzScript script(bytes);
  const UdpmLimits limits = few_parts();
  UdpmCounts counts;
  IncomingParts incoming(limits, counts, [](std::string_view channel) { return channel != "C"; });
  UdpmTime now{std::chrono::hours(1)};
  size_t whole = 0;
  while (!script.ended()) {
    const uint8_t what = script.byte();
    if (what % 8 < 6) {
      const WholeMessage sent = sent_message(what >> 4 & 3);
      const std::string digest = message_digest(sent.channel, sent.bytes);
      const size_t pieces = (sent.bytes.size() + capacity - 1) / capacity;
      const uint8_t which = script.byte();
      part_t part = cut_part(sent, digest, which >> 4 & 3, capacity, (which & 15) % pieces);
      if (what % 8 == 5) spoil(part, script);
      if (const auto came = incoming.take(part, which >> 6, now)) {
        ++whole;
        hold(came->channel == sent.channel && came->bytes == sent.bytes,
             "a message came that was not sent");
      }
    } else if (what % 8 == 6) {
      now += milliseconds(50 * script.byte());
      incoming.forget_old(now);
    } else if (const auto ask = incoming.ask(now)) {
      hold(ask->count > 0 && size_t(ask->count) == ask->index.size(), "nothing is asked for");
      for (const int32_t index : ask->index)
        hold(index >= 0 && size_t(index) < limits.parts, "a part is asked for that there is not");
    }
    hold(incoming.held_bytes() <= limits.unfinished_bytes, "too much is held");
    hold(incoming.unfinished() <= limits.unfinished_messages, "too many are unfinished");
    hold(incoming.next_due().has_value() == (incoming.unfinished() > 0), "something is never due");
  }
  incoming.forget_old(now + limits.unfinished + milliseconds(1));
  hold(incoming.held_bytes() == 0 && incoming.unfinished() == 0, "something is held for ever");
  if (whole == 0) throw InputError("no message came whole");
}

std::string sample_parts_script() {
  std::string script = {char(0x00), 0, char(0x07)};  // the shortest, and an ask
  for (const int part : {2, 0, 1}) script += {char(0x10), char(part)};
  script += {char(0x25), 0, 5, 1, char(0x06), 2, char(0x07)};
  for (int part = 4; part >= 0; --part) script += {char(0x20), char(0x50 + part)};
  return script;
}

}  // namespace genio::test
