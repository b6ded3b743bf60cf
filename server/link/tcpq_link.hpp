#pragma once
#include <chrono>
#include <list>
#include <optional>
#include <string>
#include <string_view>

#include "server/hub/descriptor.hpp"
#include "server/hub/protocol/channel_pattern.hpp"
#include "server/hub/protocol/parser.hpp"
#include "server/link/transport.hpp"

namespace genio {

/// A connection to a hub by LCM's tcpq protocol. LCM's own client is not used: it waits without end
/// for a hub that does not greet or stops in the middle of a message. Here nothing waits for longer
/// than the caller says, but for the constructor, which gives a hub one second, and publish(),
/// which gives five to one that takes nothing.
class TcpqLink final : public LinkTransport {
 public:
  /// Throws InputError when the URL cannot be used.
  explicit TcpqLink(const std::string& url);
  TcpqLink(const TcpqLink&) = delete;
  TcpqLink& operator=(const TcpqLink&) = delete;

  /// Throws InputError for what is no pattern of channels.
  void subscribe(const std::string& channel, Handler handler) override;
  /// False at once while there is no connection; wait() makes one.
  bool publish(const std::string& channel, const std::vector<uint8_t>& bytes) override;
  /// Handles one message at most, so that what it leads to does not wait for the next ones.
  bool wait(int timeout_ms, std::span<const int> others) override;
  bool connected() const override { return stage_ == Stage::open; }
  uint16_t local_port() const override;

 private:
  using Clock = std::chrono::steady_clock;
  enum class Stage { closed, connecting, greeting, open };
  struct Subscription {
    ChannelPattern pattern;
    Handler handler;
  };

  void begin();
  void go_on();
  void greet();
  void close();
  void end_if_late();
  short awaited() const;
  int patience_ms(Clock::time_point until) const;
  bool receive();
  bool take(const HubEvent& event);
  bool send(const std::vector<char>& bytes);

  const std::string url_;
  std::optional<std::string> host_;  // as numbers
  Descriptor socket_;
  Stage stage_ = Stage::closed;
  Clock::time_point began_{};  // to connect
  uint64_t connections_ = 0;   // that ended
  HubParser parser_;
  std::vector<char> buffer_;
  std::string_view unread_ = {};  // of the buffer
  std::list<Subscription> subscriptions_;
};

}  // namespace genio
