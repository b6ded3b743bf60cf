#pragma once
// The connections of a hub, and what they may take together.

#include <map>
#include <optional>

#include "server/hub/connection.hpp"

namespace genio {

/// Owns the connections. Whoever is dropped is no longer served and is removed later, so that
/// references stay good until the end of the turn. What waited for it is held until then, where
/// memory is not short: many are often dropped at once, and forgetting takes time.
class HubTable {
 public:
  explicit HubTable(const HubLimits& limits);

  /// Takes a new connection, from that port; where all places are taken, the least useful one is
  /// dropped. Throws std::bad_alloc, and the new one is closed then.
  HubConnection& admit(Descriptor socket, uint16_t port, HubTime now);
  HubConnection* find(uint64_t id);
  std::map<uint64_t, HubConnection>& all() { return connections_; }
  const std::map<uint64_t, HubConnection>& all() const { return connections_; }

  /// Drops a connection and counts why. One that was dropped before stays as it is.
  void drop(HubConnection& connection, HubDrop why);
  /// The same for one whose other side is gone, which is no fault.
  void end(HubConnection& connection);
  /// False where there is none.
  bool drop_least_useful(HubDrop why, HubTime now);
  /// The one that takes most memory.
  bool drop_heaviest(HubDrop why);

  /// Says how much of an unfinished message a connection holds now; drops those that have filled
  /// the room for these longest while there is too much of it.
  void set_partial(HubConnection& connection, HubTime now);
  /// While too much is queued in all, drops those with most waiting for them, and whoever sent most
  /// of what waits for the service.
  void keep_queue_small();
  /// Says which connection is the service's own: what others send to it waits in fair shares, and
  /// who sends it more than it reads is held back.
  void favour(HubConnection& connection);
  /// True where so much of what a connection sent waits for the service that no more of it is to be
  /// understood now. Who was held back waits until half of that is left.
  bool holds_back(const HubConnection& connection, HubTime now);
  /// Drops those with the costliest patterns while these cost too much in all.
  void keep_patterns_cheap();

  /// One that was dropped and is to be removed; nullptr where there is none.
  HubConnection* next_ended();
  bool some_ended() const;
  /// Its socket is closed with it.
  void remove(HubConnection& ended);

  const HubLimits& limits() const { return limits_; }
  HubLimits& limits() { return limits_; }
  /// The numbers of now included.
  HubCounts counts() const;
  HubCounts& counters() { return counts_; }
  size_t& held() { return held_; }

 private:
  template <class Weight>
  HubConnection* heaviest(const Weight& weight);
  HubConnection* least_useful(HubTime now);
  bool release_one_ended();
  bool drop_heaviest_share(HubConnection& receiver);
  size_t pattern_cost() const;

  HubLimits limits_;
  HubCounts counts_;
  size_t held_ = 0;     // by messages and backlogs; outlives the connections
  size_t partial_ = 0;  // sum of the standings' partial_bytes
  uint64_t next_id_ = 0;
  std::optional<uint64_t> favoured_;
  std::map<uint64_t, HubConnection> connections_;
};

}  // namespace genio
