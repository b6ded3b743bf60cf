#pragma once
#include <list>
#include <string>

#include "server/hub/protocol/channel_pattern.hpp"
#include "server/link/transport.hpp"
#include "server/udpm/incoming_parts.hpp"
#include "server/udpm/local_hosts.hpp"
#include "server/udpm/multicast_socket.hpp"
#include "server/udpm/outgoing_parts.hpp"
#include "server/udpm/pacer.hpp"

namespace genio {

/// Messages over UDP multicast, which LCM's programs can read as far as one datagram holds them.
/// LCM's own receiver is not used, since two datagrams end its process. Longer messages go in parts
/// (docs/service.md). Parts are sent, asked for and sent again while wait() runs.
class UdpmLink final : public LinkTransport {
 public:
  /// Throws InputError when the URL cannot be used, or there is no route to its group.
  explicit UdpmLink(const std::string& url, const UdpmLimits& limits = {});
  /// Sends what waits, and stays a moment for those who miss parts of what was just sent; five
  /// seconds at most.
  ~UdpmLink() override;
  UdpmLink(const UdpmLink&) = delete;
  UdpmLink& operator=(const UdpmLink&) = delete;

  /// Throws InputError for what is no pattern of channels.
  void subscribe(const std::string& channel, Handler handler) override;
  /// True also for what can never be sent, as trying again is of no use: a message above the limit
  /// or a channel above that of LCM. Those are counted.
  bool publish(const std::string& channel, const std::vector<uint8_t>& bytes) override;
  bool wait(int timeout_ms, std::span<const int> others) override;
  bool connected() const override { return true; }

  UdpmCounts counts() const;
  std::optional<UdpmCounts> udpm_counts() const override { return counts(); }

 private:
  struct Subscription {
    ChannelPattern pattern;
    Handler handler;
  };

  bool send_datagram(std::string_view channel, std::span<const uint8_t> payload, UdpmTime now);
  bool send_waiting();
  int64_t next_utime();
  UdpmTime next_turn(UdpmTime now) const;
  bool receive();
  bool handle(const MulticastSocket::Received& received, UdpmTime now);
  bool hand_over(const std::string& channel, std::span<const uint8_t> bytes);
  bool is_wanted(std::string_view channel) const;
  void take_leave() noexcept;

  const UdpmLimits limits_;
  const UdpmAddress address_;
  MulticastSocket socket_;
  LocalHosts local_hosts_;
  UdpmCounts counts_;
  std::list<Subscription> subscriptions_;
  OutgoingParts outgoing_;
  IncomingParts incoming_;
  Pacer pacer_;
  uint32_t number_ = 0;     // of the next datagram
  int64_t last_utime_ = 0;  // of a message in parts
  UdpmTime part_sent_{}, retry_at_{};
};

}  // namespace genio
