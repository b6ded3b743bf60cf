#include "server/hub/exchange.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <utility>

namespace genio {
namespace {

HubDrop reason_for(HubParser::Fault fault) {
  switch (fault) {
    case HubParser::Fault::too_large:
      return HubDrop::too_large;
    case HubParser::Fault::long_pattern:
      return HubDrop::refused_pattern;
    default:
      return HubDrop::malformed;
  }
}

/// The system goes back to late acknowledgements by itself, so this is said after every reading.
void acknowledge_at_once(int socket) {
  const int one = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_QUICKACK, &one, sizeof one);
}

}  // namespace

HubExchange::HubExchange(HubTable& table) : table_(table), buffer_(table.limits().read_bytes) {
  to_send_to_.reserve(table.limits().connections + 1);
}

void HubExchange::read_from(HubConnection& c, HubTime now, const HubTurn& turn) noexcept {
  try {
    if (!c.ended) read(c, now, turn);
  } catch (...) {  // there is nothing else to throw
    table_.drop(c, HubDrop::out_of_memory);
  }
  pass_on(now, turn);
}

void HubExchange::send_to(HubConnection& c, HubTime now, const HubTurn& turn) noexcept {
  if (!c.ended) send(c, now, turn.sent_bytes);
}

/// Sends to who got a message. Those who are not reached in the time of a turn wait for theirs.
void HubExchange::pass_on(HubTime now, const HubTurn& turn) {
  const HubTime end = HubClock::now() + turn.time;
  bool in_time = true;
  for (HubConnection* to : to_send_to_) {
    to->to_send = false;
    if (to->ended || !in_time) continue;
    send(*to, now, turn.sent_bytes);
    in_time = HubClock::now() < end;
  }
  to_send_to_.clear();
}

void HubExchange::read(HubConnection& c, HubTime now, const HubTurn& turn) {
  const std::vector<char> kept = std::exchange(c.unread, {});
  std::string_view bytes(kept.data(), kept.size());
  if (kept.empty()) bytes = {buffer_.data(), receive(c, now, turn.read_bytes)};
  if (bytes.empty()) return;
  const std::string_view rest = understand(c, bytes, now, turn.time);
  if (c.ended) return;
  c.unread.assign(rest.begin(), rest.end());
  c.in.had_more |= !rest.empty();
  table_.set_partial(c, now);
}

/// Bytes that came into the buffer; 0 when there are none or the other side is gone.
size_t HubExchange::receive(HubConnection& c, HubTime now, size_t most) {
  c.in.had_more = false;
  if (!c.reading) return 0;
  const size_t size = std::min(most, buffer_.size());
  const ssize_t count = recv(c.socket.get(), buffer_.data(), size, MSG_DONTWAIT);
  if (count > 0) {
    acknowledge_at_once(c.socket.get());
    table_.counters().bytes_in += size_t(count);
    c.heard = now;
    c.in.had_more = size_t(count) == size;
    return size_t(count);
  }
  if (count == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) table_.end(c);
  return 0;
}

/// The bytes that are left when the turn is over.
std::string_view HubExchange::understand(HubConnection& c, std::string_view bytes, HubTime now,
                                         HubClock::duration longest) {
  const HubTime end = HubClock::now() + longest;
  while (!c.ended) {
    std::optional<HubEvent> event = c.parser.next(bytes);
    if (!event) break;
    handle(c, std::move(*event), now);
    if (HubClock::now() >= end || table_.holds_back(c, now)) break;
  }
  if (!c.ended && c.parser.fault() != HubParser::Fault::none)
    table_.drop(c, reason_for(c.parser.fault()));
  return bytes;
}

void HubExchange::handle(HubConnection& c, HubEvent event, HubTime now) {
  c.standing.active = now;
  c.standing.partial = false;
  switch (event.kind) {
    case HubEvent::Kind::greeting:
      c.standing.greeted = true;
      return;
    case HubEvent::Kind::unsubscribe:
      c.subscriptions.remove(event.name());
      return;
    case HubEvent::Kind::subscribe:
      c.standing.took_part = true;
      if (c.subscriptions.add(event.name())) table_.keep_patterns_cheap();
      else table_.drop(c, HubDrop::refused_pattern);
      return;
    case HubEvent::Kind::publish:
      c.standing.took_part = true;
      ++table_.counters().messages_in;
      relay(c, std::move(event), now);
      return;
  }
}

void HubExchange::relay(const HubConnection& from, HubEvent event, HubTime now) {
  const std::string_view channel = event.name();  // its bytes stay where they are
  const auto message = std::make_shared<const HubMessage>(std::move(event.frame), table_.held());
  for (auto& [id, to] : table_.all())
    if (!to.ended && to.subscriptions.want(channel)) hand_over(from, to, message, now);
  table_.keep_queue_small();
}

void HubExchange::hand_over(const HubConnection& from, HubConnection& to,
                            const std::shared_ptr<const HubMessage>& message, HubTime now) {
  try {
    if (to.backlog.empty()) to.standing.drained = now;
    to.backlog.push(message, from.id, is_newcomer(from.standing, now));
    if (!std::exchange(to.to_send, true)) to_send_to_.push_back(&to);
  } catch (const std::bad_alloc&) {
    return table_.drop(to, HubDrop::out_of_memory);
  }
  to.standing.backlog_bytes = to.backlog.bytes();
  const HubLimits& limits = table_.limits();
  // Who sends too much to the service is held back instead.
  if (to.standing.favoured) return;
  if (to.backlog.bytes() > limits.backlog_bytes || to.backlog.messages() > limits.backlog_messages)
    table_.drop(to, HubDrop::slow_reader);
}

void HubExchange::send(HubConnection& c, HubTime now, size_t most) {
  c.out.had_more = false;
  if (c.backlog.empty()) return;
  const HubBacklog::Sent sent = c.backlog.send_to(c.socket.get(), most);
  if (sent.broken) return table_.end(c);
  c.out.had_more = sent.bytes > 0 && !c.backlog.empty();
  HubCounts& counts = table_.counters();
  counts.bytes_out += sent.bytes;
  counts.messages_out += sent.messages;
  // The first is the hub's greeting, and no publication.
  if (sent.messages > 0 && !std::exchange(c.welcomed, true)) --counts.messages_out;
  if (sent.bytes > 0) c.standing.drained = c.standing.active = now;
  c.standing.backlog_bytes = c.backlog.bytes();
}

}  // namespace genio
