#pragma once
#include <list>
#include <string>

#include "server/link/transport.hpp"

struct _lcm_t;  // NOLINT(bugprone-reserved-identifier): LCM's own name

namespace genio {

/// LCM's own connection to a hub.
class TcpqLink final : public LinkTransport {
 public:
  /// Throws InputError when the URL cannot be used.
  explicit TcpqLink(const std::string& url);
  ~TcpqLink() override;
  TcpqLink(const TcpqLink&) = delete;
  TcpqLink& operator=(const TcpqLink&) = delete;

  void subscribe(const std::string& channel, Handler handler) override;
  bool publish(const std::string& channel, const std::vector<uint8_t>& bytes) override;
  bool wait(int timeout_ms, std::span<const int> others) override;
  bool connected() const override;
  uint16_t local_port() const override;

 private:
  struct Subscription;
  void tune();
  void create(const std::string& url);
  bool connect();

  std::string url_;
  _lcm_t* lcm_ = nullptr;
  int tuned_fd_ = -1;
  std::list<Subscription> subscriptions_;
};

}  // namespace genio
