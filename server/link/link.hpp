#pragma once
// One LCM connection, owned by one thread, that survives what LCM 1.3.1 does not.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "server/link/transport.hpp"

namespace genio {

inline constexpr const char* default_url = "tcpq://127.0.0.1:7700";

/// --lcm, else LCM_DEFAULT_URL, else default_url.
std::string choose_url(const std::string& option);

/// By LCM's tcpq (TcpqLink) or its udpm (UdpmLink); neither goes by LCM itself.
class Link {
 public:
  using Handler = LinkTransport::Handler;

  /// Throws InputError when the URL cannot be used. It need not be answered yet.
  explicit Link(const std::string& url);

  /// `channel` is a regular expression that a whole channel must match. What `handler` throws ends
  /// the handling of that message alone, and is counted.
  void subscribe(const std::string& channel, Handler handler);
  /// False when the connection is down, or has more to send than it can keep.
  bool publish(const std::string& channel, const std::vector<uint8_t>& bytes);
  /// Waits up to `timeout_ms` for a message, or for one of `others` to become readable, and handles
  /// what is there. False when the connection is down, which a later call mends.
  bool wait(int timeout_ms, std::span<const int> others = {});
  bool connected() const;
  /// At this side of the connection to a hub; 0 where there is none.
  uint16_t local_port() const { return transport_->local_port(); }
  LinkCounts counts() const;
  /// The newest messages, a few, whose handling failed since the last call.
  std::vector<FailedHandling> take_failures();

 private:
  struct Failures {
    uint64_t count = 0;
    std::vector<FailedHandling> newest;
  };
  static void note(Failures& failures, const std::string& channel, size_t size,
                   const char* reason) noexcept;

  std::unique_ptr<Failures> failures_ = std::make_unique<Failures>();  // outlives the handlers
  std::unique_ptr<LinkTransport> transport_;
};

}  // namespace genio
