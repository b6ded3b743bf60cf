#pragma once
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "server/hub/descriptor.hpp"
#include "server/hub/protocol/parser.hpp"
#include "server/hub/protocol/subscriptions.hpp"
#include "server/hub/queues/backlog.hpp"
#include "server/hub/standing.hpp"

namespace genio {

/// What a hub knows of one direction of a connection, from it or to it.
struct HubDirection {
  bool ready = false;                    ///< as the system said last
  bool had_more = false;                 ///< its last turn left something that could be done
  std::optional<HubTime> waiting_since;  ///< for its turn
};

/// All that a hub holds of one connection.
struct HubConnection {
  HubConnection(uint64_t its_id, Descriptor its_socket, uint16_t its_port, const HubLimits& limits,
                size_t& held, HubTime now)
      : id(its_id),
        port(its_port),
        socket(std::move(its_socket)),
        parser(limits.name_bytes, limits.payload_bytes),
        subscriptions(limits.subscriptions, limits.programs),
        backlog(held),
        usage(now) {
    standing.accepted = standing.active = standing.drained = heard = now;
  }

  const uint64_t id;
  const uint16_t port;  ///< of the other side
  Descriptor socket;
  HubParser parser;
  std::vector<char> unread;  ///< received, and left for its next turn
  HubSubscriptions subscriptions;
  HubBacklog backlog;
  HubStanding standing;
  HubUsage usage;

  HubDirection in, out;
  std::optional<uint32_t> watched;  ///< events that the system was asked for
  bool to_send = false;             ///< has got a message in this turn
  bool welcomed = false;            ///< the hub's own greeting was sent
  bool reading = true;              ///< false when the hub ends and no more is expected
  HubTime heard;                    ///< when bytes came last
  bool ended = false;               ///< to be removed at the end of the turn
};

}  // namespace genio
