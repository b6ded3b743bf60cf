#include "server/hub/table.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <utility>

#include "server/hub/protocol/tcpq.hpp"

namespace genio {
namespace {

/// Half of the process's descriptors at most: the service and its files need some too.
size_t affordable_connections(size_t wanted) {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    wanted = std::min<size_t>(wanted, limit.rlim_cur / 2);
  return std::max<size_t>(wanted, 1);
}

constexpr int most_unsent = 4 << 10;  // bytes
// What waits for the service of one sender before more of it is understood, and of all senders.
constexpr size_t full_messages = 64, full_bytes = 64 << 10, crowded_bytes = 16 << 20;

bool has_ended(const std::pair<const uint64_t, HubConnection>& entry) { return entry.second.ended; }

}  // namespace

/// The one of greatest weight; none where all weigh nothing.
template <class Weight>
HubConnection* HubTable::heaviest(const Weight& weight) {
  HubConnection* found = nullptr;
  double most = 0;
  for (auto& [id, c] : connections_) {
    const double w = c.ended ? 0 : weight(c);
    if (w > most) found = &c, most = w;
  }
  return found;
}

HubTable::HubTable(const HubLimits& limits) : limits_(limits) {
  limits_.connections = affordable_connections(limits.connections);
}

HubConnection& HubTable::admit(Descriptor socket, uint16_t port, HubTime now) {
  const auto stay = [](const auto& entry) { return !entry.second.ended; };
  const auto present = size_t(std::count_if(connections_.begin(), connections_.end(), stay));
  if (present >= limits_.connections) drop_least_useful(HubDrop::displaced, now);
  const uint64_t id = next_id_++;
  const auto place =
      connections_.try_emplace(id, id, std::move(socket), port, limits_, held_, now).first;
  HubConnection& connection = place->second;
  try {
    connection.backlog.push(
        std::make_shared<const HubMessage>(tcpq::greeting(tcpq::server_mark), held_));
  } catch (...) {
    connections_.erase(place);
    throw;
  }
  connection.standing.backlog_bytes = connection.backlog.bytes();
  ++counts_.accepted;
  return connection;
}

HubConnection* HubTable::find(uint64_t id) {
  const auto found = connections_.find(id);
  return found == connections_.end() ? nullptr : &found->second;
}

void HubTable::end(HubConnection& c) {
  if (std::exchange(c.ended, true)) return;
  partial_ -= std::exchange(c.standing.partial_bytes, 0);
  c.standing.backlog_bytes = 0;
  c.standing.partial = false;
  c.subscriptions.clear();
  c.parser.abandon();
  c.unread = std::vector<char>();  // gives the memory back, as {} would not
}

void HubTable::drop(HubConnection& c, HubDrop why) {
  if (c.ended) return;
  ++counts_.dropped(why);
  end(c);
  if (why == HubDrop::out_of_memory) c.backlog.clear();
}

HubConnection* HubTable::least_useful(HubTime now) {
  HubConnection* found = nullptr;
  for (auto& [id, c] : connections_)
    if (!c.ended && (!found || less_useful(c.standing, found->standing, now))) found = &c;
  return found;
}

bool HubTable::drop_least_useful(HubDrop why, HubTime now) {
  HubConnection* const c = least_useful(now);
  if (c) drop(*c, why);
  return c;
}

bool HubTable::drop_heaviest(HubDrop why) {
  HubConnection* const c = heaviest([](const HubConnection& k) {
    return double(1 + k.standing.partial_bytes + k.backlog.bytes());
  });
  if (c) drop(*c, why);
  return c;
}

void HubTable::set_partial(HubConnection& c, HubTime now) {
  if (c.ended) return;
  HubStanding& s = c.standing;
  if (!s.partial) s.partial_began = now;
  s.partial_grew = now;
  s.partial = c.parser.partial();
  partial_ -= s.partial_bytes;
  s.partial_bytes = c.parser.held() + c.unread.capacity();
  partial_ += s.partial_bytes;
  const auto burden = [&](const HubConnection& k) { return partial_burden(k.standing, now); };
  while (partial_ > limits_.partial_bytes)
    if (HubConnection* const worst = heaviest(burden)) drop(*worst, HubDrop::stalled);
    else break;
}

bool HubTable::release_one_ended() {
  for (auto& [id, c] : connections_) {
    if (!c.ended || c.backlog.empty()) continue;
    c.backlog.clear();
    return true;
  }
  return false;
}

void HubTable::keep_queue_small() {
  const auto waiting = [](const HubConnection& k) { return double(k.backlog.bytes()); };
  while (held_ > limits_.queued_bytes) {
    if (release_one_ended()) continue;
    HubConnection* const worst = heaviest(waiting);
    if (!worst) break;
    if (!drop_heaviest_share(*worst)) drop(*worst, HubDrop::slow_reader);
  }
}

/// False where the connection has none.
bool HubTable::drop_heaviest_share(HubConnection& receiver) {
  const auto sender = receiver.backlog.forget_heaviest();
  if (!sender) return false;
  receiver.standing.backlog_bytes = receiver.backlog.bytes();
  if (HubConnection* const c = find(*sender)) drop(*c, HubDrop::crowds_service);
  else ++counts_.dropped(HubDrop::crowds_service);
  return true;
}

void HubTable::favour(HubConnection& c) {
  favoured_ = c.id;
  c.backlog.share_fairly();
  // What stands in the buffers of the system can no longer give way to others.
  setsockopt(c.socket.get(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &most_unsent, sizeof most_unsent);
}

bool HubTable::holds_back(const HubConnection& c, HubTime now) {
  const HubConnection* const service = favoured_ ? find(*favoured_) : nullptr;
  if (!service || service->ended || c.standing.favoured) return false;
  const HubFairQueue::Share share = service->backlog.share(c.id);
  if (service->backlog.bytes() > crowded_bytes)
    return share.messages > 0 || c.standing.partial_bytes > full_bytes;
  const size_t part = c.standing.held_back ? 2 : 1;
  const auto is_full = [part](const HubFairQueue::Share& s) {
    return s.messages > full_messages / part || s.bytes > full_bytes / part;
  };
  return is_full(share) || (is_newcomer(c.standing, now) && is_full(service->backlog.newcomers()));
}

size_t HubTable::pattern_cost() const {
  size_t sum = 0;
  for (const auto& [id, c] : connections_) sum += c.subscriptions.cost();
  return sum;
}

void HubTable::keep_patterns_cheap() {
  const auto cost = [](const HubConnection& k) { return double(k.subscriptions.cost()); };
  while (pattern_cost() > limits_.program_cost)
    if (HubConnection* const worst = heaviest(cost)) drop(*worst, HubDrop::refused_pattern);
    else break;
}

HubConnection* HubTable::next_ended() {
  const auto found = std::find_if(connections_.begin(), connections_.end(), has_ended);
  return found == connections_.end() ? nullptr : &found->second;
}

bool HubTable::some_ended() const {
  return std::any_of(connections_.begin(), connections_.end(), has_ended);
}

void HubTable::remove(HubConnection& ended) { connections_.erase(ended.id); }

HubCounts HubTable::counts() const {
  HubCounts now = counts_;
  now.queued_bytes = held_, now.partial_bytes = partial_;
  for (const auto& [id, c] : connections_) {
    if (c.ended) continue;
    ++now.connections;
    now.subscriptions += c.subscriptions.size();
  }
  return now;
}

}  // namespace genio
