#pragma once
// What happens when a connection of a hub has its turn: reading, relaying, sending.

#include <memory>
#include <string_view>
#include <vector>

#include "server/hub/table.hpp"
#include "server/hub/turns/round.hpp"

namespace genio {

/// Reads from connections and sends to them, a bounded amount at a time.
class HubExchange {
 public:
  explicit HubExchange(HubTable& table);

  /// A turn of one connection: what it sent is understood, and passed on to who wants it, as far
  /// as the limits of a turn allow. Nothing is thrown: memory that is not there costs the
  /// connection.
  void read_from(HubConnection& connection, HubTime now, const HubTurn& turn) noexcept;
  /// The same for what waits until it is sent to the connection.
  void send_to(HubConnection& connection, HubTime now, const HubTurn& turn) noexcept;

 private:
  void read(HubConnection& c, HubTime now, const HubTurn& turn);
  size_t receive(HubConnection& c, HubTime now, size_t most);
  std::string_view understand(HubConnection& c, std::string_view bytes, HubTime now,
                              HubClock::duration longest);
  void handle(HubConnection& c, HubEvent event, HubTime now);
  void relay(const HubConnection& from, HubEvent event, HubTime now);
  void hand_over(const HubConnection& from, HubConnection& to,
                 const std::shared_ptr<const HubMessage>& message, HubTime now);
  void send(HubConnection& c, HubTime now, size_t most);
  void pass_on(HubTime now, const HubTurn& turn);

  HubTable& table_;
  std::vector<char> buffer_;                // of one turn's bytes
  std::vector<HubConnection*> to_send_to_;  // who got a message in this turn
};

}  // namespace genio
