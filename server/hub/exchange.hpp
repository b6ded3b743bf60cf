#pragma once
// What happens when a connection of a hub has its turn: reading, relaying, sending.

#include <memory>
#include <string_view>
#include <vector>

#include "server/hub/table.hpp"

namespace genio {

/// Reads from connections and sends to them, a bounded amount at a time.
class HubExchange {
 public:
  explicit HubExchange(HubTable& table);

  /// A turn of one connection: what waits for it is sent, and what it sent is understood, as far as
  /// the limits of a turn allow. Understanding takes `longest` and one message more at most, and so
  /// does passing on. Nothing is thrown: memory that is not there costs the connection.
  void serve(HubConnection& connection, HubTime now, HubClock::duration longest) noexcept;

 private:
  void read(HubConnection& c, HubTime now, HubClock::duration longest);
  size_t receive(HubConnection& c, HubTime now);
  std::string_view understand(HubConnection& c, std::string_view bytes, HubTime now,
                              HubClock::duration longest);
  void handle(HubConnection& c, HubEvent event, HubTime now);
  void relay(HubEvent event, HubTime now);
  void hand_over(HubConnection& to, const std::shared_ptr<const HubMessage>& message, HubTime now);
  void send(HubConnection& c, HubTime now);
  void pass_on(HubTime now, HubClock::duration longest);

  HubTable& table_;
  std::vector<char> buffer_;                // of one turn's bytes
  std::vector<HubConnection*> to_send_to_;  // who got a message in this turn
};

}  // namespace genio
