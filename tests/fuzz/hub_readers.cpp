// What a client of the hub sends: bytes that arrive in any pieces.

#include <re2/re2.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "forward/base/types.hpp"
#include "server/hub/protocol/parser.hpp"
#include "server/hub/protocol/subscriptions.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "tests/fuzz/fuzz_reader.hpp"
#include "tests/fuzz/fuzz_script.hpp"
#include "tests/fuzz/hub_script.hpp"

namespace genio::test {
namespace {

constexpr size_t most_patterns = 8, most_programs = 4;

struct Limits {
  size_t name, payload;
};

/// What a parser made of a connection's bytes.
struct Heard {
  std::vector<HubEvent> events;
  HubParser::Fault fault = HubParser::Fault::none;
};

size_t total_of(const std::vector<HubEvent>& events) {
  size_t total = 0;
  for (const HubEvent& e : events) total += e.frame.size();
  return total;
}

/// `pieces`: lengths of what arrives together; what is left arrives last.
Heard hear(std::string_view bytes, std::string_view pieces, const Limits& limits) {
  HubParser parser(limits.name, limits.payload);
  Heard heard;
  const std::string_view all = bytes;
  for (size_t k = 0; !bytes.empty() && parser.fault() == HubParser::Fault::none; ++k) {
    std::string_view piece = bytes;
    if (k < pieces.size()) piece = bytes.substr(0, size_t(uint8_t(pieces[k])) + 1);
    bytes.remove_prefix(piece.size());
    while (auto event = parser.next(piece)) {
      hold(event->name().size() <= limits.name, "a name above its limit");
      hold(event->payload().size() <= limits.payload, "a payload above its limit");
      heard.events.push_back(std::move(*event));
    }
    const size_t came = all.size() - bytes.size() - piece.size(), whole = total_of(heard.events);
    const bool faulty = parser.fault() != HubParser::Fault::none;
    hold(piece.empty() || faulty, "bytes are left without a fault");
    hold(came >= whole && parser.held() <= 4 * (came - whole) + 32,
         "more memory than four times what came");
    hold(faulty || parser.partial() == (came > whole), "a message is whole or has begun");
  }
  heard.fault = parser.fault();
  if (heard.fault == HubParser::Fault::none) return heard;
  std::string_view more = "\x28\x76\x17\xfb\0\0\1\0";
  hold(!parser.next(more) && parser.fault() == heard.fault, "the parser goes on after a fault");
  parser.abandon();
  hold(parser.held() == 0 && !parser.next(more), "memory is held after a fault");
  return heard;
}

void expect_same(const Heard& a, const Heard& b, std::string_view bytes) {
  hold(a.fault == b.fault && a.events.size() == b.events.size(), "pieces change what is heard");
  size_t at = 0;
  for (size_t k = 0; k < a.events.size(); ++k) {
    const std::vector<char>& frame = a.events[k].frame;
    hold(frame == b.events[k].frame && a.events[k].kind == b.events[k].kind &&
             a.events[k].name_bytes == b.events[k].name_bytes,
         "pieces change a message");
    hold(bytes.substr(at, frame.size()) == std::string_view(frame.data(), frame.size()),
         "a message is not made of the bytes that came");
    at += frame.size();
  }
}

/// Patterns as RE2 itself has them, without the short cuts for names and for .* at the end.
class PlainPatterns {
 public:
  void add(std::string_view text) {
    RE2::Options options;
    options.set_log_errors(false);
    options.set_encoding(RE2::Options::EncodingLatin1);
    options.set_dot_nl(true);
    auto program = std::make_unique<RE2>(re2::StringPiece(text.data(), text.size()), options);
    hold(program->ok(), "a pattern is taken that is none");
    patterns_.emplace_back(std::string(text), std::move(program));
  }
  void remove(std::string_view text) {
    const auto found = std::find_if(patterns_.begin(), patterns_.end(),
                                    [&](const auto& p) { return p.first == text; });
    if (found != patterns_.end()) patterns_.erase(found);
  }
  bool want(std::string_view channel) const {
    return std::any_of(patterns_.begin(), patterns_.end(), [&](const auto& p) {
      return RE2::FullMatch(re2::StringPiece(channel.data(), channel.size()), *p.second);
    });
  }
  size_t size() const { return patterns_.size(); }

 private:
  std::vector<std::pair<std::string, std::unique_ptr<RE2>>> patterns_;
};

/// Takes and ends subscriptions as told, and asks of every publication whether it is wanted.
void follow(const std::vector<HubEvent>& events) {
  HubSubscriptions subscriptions(most_patterns, most_programs);
  PlainPatterns plain;
  for (const HubEvent& event : events) {
    if (event.kind == HubEvent::Kind::subscribe && subscriptions.add(event.name()))
      plain.add(event.name());
    if (event.kind == HubEvent::Kind::unsubscribe)
      subscriptions.remove(event.name()), plain.remove(event.name());
    if (event.kind == HubEvent::Kind::publish)
      hold(subscriptions.want(event.name()) == plain.want(event.name()),
           "a channel is matched as RE2 does not");
    hold(subscriptions.size() == plain.size() && plain.size() <= most_patterns,
         "patterns are lost, or there are too many");
    hold(subscriptions.cost() <= most_programs * 300, "programs cost more than their limit");
  }
  subscriptions.clear();
  hold(subscriptions.size() == 0 && subscriptions.cost() == 0, "patterns are left");
}

/// The first byte says how large names and payloads may be, the second how many lengths of pieces
/// follow.
void read_connection(const std::string& path) {
  const std::string input = bytes_of_file(path);
  FuzzScript script(input);
  const size_t size = script.byte();
  const Limits limits{size % 2 ? 256u : 24u, size % 4 < 2 ? 1u << 20 : 40u};
  const std::string_view pieces = script.take(script.below(64)), bytes = script.rest();
  const Heard whole = hear(bytes, {}, limits), cut = hear(bytes, pieces, limits);
  expect_same(whole, cut, bytes);
  follow(whole.events);
  if (whole.fault != HubParser::Fault::none) throw InputError("what LCM does not say");
  if (total_of(whole.events) < bytes.size()) throw InputError("a message ends early");
}

void append(std::string& text, const std::vector<char>& bytes) {
  text.append(bytes.begin(), bytes.end());
}

std::string sample_connection(const std::string& pieces) {
  std::string text = std::string(1, '\1') + char(pieces.size()) + pieces;
  append(text, tcpq::greeting(tcpq::client_mark));
  for (const char* pattern : {"GENIO_REPLY.me", "GENIO_.*", "A(B|C)[0-9]+", "GENIO_REPLY.me"})
    append(text, tcpq::subscription(pattern));
  append(text, tcpq::publication("GENIO_REQUEST", "bytes"));
  append(text, tcpq::publication("AB12", ""));
  append(text, tcpq::subscription("GENIO_.*", tcpq::unsubscribe));
  append(text, tcpq::publication("GENIO_STATUS", std::string("\0\1\2", 3)));
  return text;
}

}  // namespace

std::vector<FuzzReader> hub_readers() {
  return {{"hub",
           "connection",
           {sample_connection(""), sample_connection(std::string("\0\1\7\2", 4))},
           read_connection},
          {"hub_relay", "script", {sample_hub_script()}, [](const std::string& path) {
             play_hub_script(bytes_of_file(path));
           }}};
}

}  // namespace genio::test
