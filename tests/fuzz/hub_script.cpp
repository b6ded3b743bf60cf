#include "tests/fuzz/hub_script.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "forward/base/types.hpp"
#include "server/hub/exchange.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "tests/fuzz/fuzz_script.hpp"

namespace genio::test {
namespace {

using std::chrono::milliseconds;
using Frame = std::vector<char>;

constexpr size_t places = 4;                // of clients that a script speaks of
constexpr size_t greetings = 200 * places;  // bytes: they are queued whatever else is
constexpr const char* channels[] = {"A", "B", "A.B", "GENIO_REPLY.me", "", "AAAA"};
constexpr const char* patterns[] = {"A", ".*", "A.*", "(A|B)+", "GENIO_.*", "A.B", "[", "(a*)*b"};

HubLimits small_limits() {
  HubLimits limits;
  limits.connections = places - 1;  // so that some are displaced
  limits.name_bytes = 40, limits.payload_bytes = 3000;
  limits.subscriptions = 4, limits.programs = 2, limits.program_cost = 100;
  limits.backlog_bytes = 2000, limits.backlog_messages = 20;
  limits.queued_bytes = 4000, limits.partial_bytes = 4000;
  return limits;
}

/// What the model expects one to receive. Of a sender that was dropped meanwhile it is not known
/// how much was passed on.
struct ExpectedFrame {
  Frame frame;
  bool surely;
};

/// A client, and what the model knows of it. It is without a connection once the hub has ended it.
struct ModelClient {
  uint64_t id = 0;
  Descriptor socket;
  HubParser parser;
  HubSubscriptions subscriptions;
  std::vector<ExpectedFrame> expected;
  Frame received;
};

size_t frame_bytes(const Frame& bytes, size_t at) {
  constexpr size_t word = tcpq::word_bytes;
  if (at == 0) return tcpq::greeting_bytes;
  if (bytes.size() < at + 2 * word) return bytes.size() + 1;
  const size_t payload_at = at + 2 * word + tcpq::word_at(bytes, at + word);
  if (bytes.size() < payload_at + word) return bytes.size() + 1;
  return payload_at + word + tcpq::word_at(bytes, payload_at) - at;
}

/// The whole messages among bytes that a client received; `half`: some of another follow.
std::vector<Frame> frames_of(const Frame& bytes, bool& half) {
  std::vector<Frame> frames;
  size_t at = 0;
  for (size_t size = 0; at < bytes.size(); at += size) {
    size = frame_bytes(bytes, at);
    if (size > bytes.size() - at) break;
    frames.emplace_back(bytes.begin() + std::ptrdiff_t(at),
                        bytes.begin() + std::ptrdiff_t(at + size));
  }
  half = at < bytes.size();
  return frames;
}

/// Where one may be among what is expected after all that was received, in increasing order: who
/// may have been left out may have come as well.
std::vector<size_t> places_after(const std::vector<Frame>& received,
                                 const std::vector<ExpectedFrame>& expected) {
  std::vector<char> here(expected.size() + 1, 0);
  here[0] = 1;
  const auto leave_out = [&] {
    for (size_t k = 0; k < expected.size(); ++k)
      if (here[k] && !expected[k].surely) here[k + 1] = 1;
  };
  leave_out();
  for (const Frame& frame : received) {
    for (size_t k = expected.size(); k > 0; --k)
      here[k] = here[k - 1] && expected[k - 1].frame == frame;
    here[0] = 0;
    leave_out();
  }
  std::vector<size_t> found;
  for (size_t k = 0; k < here.size(); ++k)
    if (here[k]) found.push_back(k);
  return found;
}

class ModelledHub {
 public:
  /// How many publications clients have received.
  size_t passed = 0;

  void connect(size_t place) {
    std::array<int, 2> pair{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, pair.data()) != 0)
      throw std::runtime_error("no sockets");
    leave(place);
    Descriptor there(pair[1]);
    const HubConnection& c = table_.admit(Descriptor(pair[0]), uint16_t(place), now_);
    const HubLimits& limits = table_.limits();
    clients_.insert_or_assign(place, ModelClient{c.id,
                                                 std::move(there),
                                                 {limits.name_bytes, limits.payload_bytes},
                                                 {limits.subscriptions, limits.programs},
                                                 {{tcpq::greeting(tcpq::server_mark), true}},
                                                 {}});
    check();
  }

  /// The client closes its side.
  void leave(size_t place) {
    const auto client = clients_.find(place);
    if (client == clients_.end()) return;
    const uint64_t id = client->second.id;
    take(client->second);
    judge(client->second, false);
    clients_.erase(client);
    while (HubConnection* const c = alive(id)) exchange_.read_from(*c, now_, turn_);
    check();
  }

  void send(size_t place, std::string_view bytes) {
    const auto client = clients_.find(place);
    if (client == clients_.end() || bytes.empty()) return;
    const uint64_t id = client->second.id;
    if (::send(client->second.socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) return;
    do {
      if (HubConnection* const c = alive(id)) exchange_.read_from(*c, now_, turn_);
    } while (has_more(id));
    expect(client->second, bytes);
    check();
  }

  /// The hub sends to a client what waits for it, and the client reads it.
  void receive(size_t place) {
    const auto client = clients_.find(place);
    if (client == clients_.end()) return;
    if (HubConnection* const c = alive(client->second.id)) exchange_.send_to(*c, now_, turn_);
    take(client->second);
    check();
  }

  void wait(milliseconds time) {
    now_ += time;
    for (auto& [id, c] : table_.all()) {
      const auto due = hub_due(c.standing, table_.limits());
      if (!c.ended && due && due->at <= now_) table_.drop(c, due->why);
    }
    check();
  }

  void set_turn(const HubTurn& turn) { turn_ = turn; }

  void finish() {
    for (auto& [place, client] : clients_) {
      HubConnection* c = alive(client.id);
      while (c && !c->ended && !c->backlog.empty())
        exchange_.send_to(*c, now_, turn_), take(client);
      take(client);
      judge(client, c && !c->ended);
    }
    for (auto& [id, c] : table_.all()) table_.end(c);
    while (HubConnection* const c = table_.next_ended()) table_.remove(*c);
    hold(table_.held() == 0 && table_.counts().partial_bytes == 0, "something is held for nobody");
  }

 private:
  HubConnection* alive(uint64_t id) {
    HubConnection* const c = table_.find(id);
    return c && !c->ended ? c : nullptr;
  }

  bool has_more(uint64_t id) {
    const HubConnection* const c = alive(id);
    return c && (c->in.had_more || !c->unread.empty());
  }

  /// What follows from bytes that the hub has read.
  void expect(ModelClient& from, std::string_view bytes) {
    const bool surely = alive(from.id);
    while (auto event = from.parser.next(bytes)) {
      if (event->kind == HubEvent::Kind::subscribe)
        hold(from.subscriptions.add(event->name()) || !surely, "a pattern is not refused");
      if (event->kind == HubEvent::Kind::unsubscribe) from.subscriptions.remove(event->name());
      if (event->kind != HubEvent::Kind::publish) continue;
      for (auto& [place, to] : clients_)
        if (to.subscriptions.want(event->name())) to.expected.push_back({event->frame, surely});
    }
    hold(!surely || from.parser.fault() == HubParser::Fault::none, "a fault is not noticed");
  }

  void take(ModelClient& client) {
    std::array<char, 4096> buffer;
    for (ssize_t n; (n = recv(client.socket.get(), buffer.data(), buffer.size(), 0)) > 0;)
      client.received.insert(client.received.end(), buffer.begin(), buffer.begin() + n);
  }

  /// `whole`: the hub has sent all that it had for the client.
  void judge(const ModelClient& client, bool whole) {
    bool half = false;
    const std::vector<Frame> frames = frames_of(client.received, half);
    const auto after = places_after(frames, client.expected);
    hold(!after.empty(), "a message came that was not expected then");
    hold(!whole || (!half && after.back() == client.expected.size()), "a message did not come");
    passed += frames.empty() ? 0 : frames.size() - 1;  // without the greeting
  }

  /// Whatever happens, this holds.
  void check() {
    const HubCounts counts = table_.counts();
    const HubLimits& limits = table_.limits();
    hold(counts.connections <= limits.connections, "too many connections");
    hold(counts.partial_bytes <= limits.partial_bytes, "too much of unfinished messages");
    hold(counts.queued_bytes <= limits.queued_bytes + greetings, "too much waits");
    for (const auto& [id, c] : table_.all())
      hold(c.ended || (c.backlog.bytes() <= limits.backlog_bytes &&
                       c.backlog.messages() <= limits.backlog_messages),
           "too much waits for one");
    while (HubConnection* const c = table_.next_ended()) table_.remove(*c);
  }

  HubTime now_{std::chrono::hours(1)};
  HubTurn turn_{milliseconds(1000), 4096, 4096};
  HubTable table_{small_limits()};
  HubExchange exchange_{table_};
  std::map<size_t, ModelClient> clients_;
};

std::string_view text(const std::vector<char>& bytes) { return {bytes.data(), bytes.size()}; }

}  // namespace

void play_hub_script(const std::string& bytes) {
  FuzzScript script(bytes);
  ModelledHub hub;
  while (!script.ended()) {
    const uint8_t what = script.byte();
    const size_t place = what >> 4 & 3;
    switch (what % 10) {
      case 0:
        hub.connect(place);
        hub.send(place, text(tcpq::greeting(tcpq::client_mark)));
        break;
      case 1:
        hub.connect(place);
        break;
      case 2:
        hub.send(place, text(tcpq::subscription(patterns[script.below(std::size(patterns))])));
        break;
      case 3:
        hub.send(place, text(tcpq::subscription(patterns[script.below(std::size(patterns))],
                                                tcpq::unsubscribe)));
        break;
      case 4: {
        const char* const channel = channels[script.below(std::size(channels))];
        hub.send(place, text(tcpq::publication(channel, std::string(4 * script.byte(), 'x'))));
        break;
      }
      case 5:
        hub.send(place, script.take(size_t(script.byte()) + 1));
        break;
      case 6:
        hub.receive(place);
        break;
      case 7:
        hub.wait(milliseconds(10 * script.byte()));
        break;
      case 8:
        hub.leave(place);
        break;
      default: {
        const size_t some = script.byte();
        hub.set_turn({milliseconds(some % 2 ? 1000 : 0), some % 64 + 1, some % 32 + 1});
        break;
      }
    }
  }
  hub.finish();
  if (hub.passed == 0) throw InputError("no message passes");
}

std::string sample_hub_script() {
  std::string script;
  const auto add = [&](int what, int place, std::string_view more = {}) {
    int code = 0;
    while (code % 10 != what || (code >> 4 & 3) != place) ++code;
    script += char(code);
    script += more;
  };
  for (const int place : {0, 1, 2}) add(0, place);
  add(2, 0, "\1"), add(2, 1, "\2"), add(2, 1, "\3");
  add(9, 0, "\12");
  add(4, 2, {"\0\7", 2}), add(4, 2, "\2\1"), add(4, 0, "\5\3");
  add(5, 2, {"\15\0\0\0\1\0\0\0\1A\0\0\0\0\0", 15});
  add(3, 1, "\2"), add(4, 2, "\1\1"), add(6, 0), add(6, 1), add(7, 0, "\1"), add(8, 1);
  return script;
}

}  // namespace genio::test
