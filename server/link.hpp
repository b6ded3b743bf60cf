#pragma once
// One LCM connection, owned by one thread, that survives what LCM 1.3.1 does not.

#include <cstdint>
#include <functional>
#include <list>
#include <span>
#include <string>
#include <vector>

struct _lcm_t;

namespace genio {

inline constexpr const char* default_url = "tcpq://127.0.0.1:7700";

/// --lcm, else LCM_DEFAULT_URL, else default_url.
std::string choose_url(const std::string& option);

class Link {
 public:
  using Handler = std::function<void(const std::string& channel, const void* data, size_t size)>;

  /// Throws InputError when the URL cannot be used. It need not be answered yet.
  explicit Link(const std::string& url);
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  void subscribe(const std::string& channel, Handler handler);
  /// False when the connection is down.
  bool publish(const std::string& channel, const std::vector<uint8_t>& bytes);
  /// Waits up to `timeout_ms` for a message, or for one of `others` to become readable, and handles
  /// the message that is there. False when the connection is down, which a later call mends.
  bool wait(int timeout_ms, std::span<const int> others = {});
  bool connected() const;

 private:
  struct Subscription;
  void tune();
  void create(const std::string& url);
  bool connect();

  std::string url_;
  _lcm_t* lcm_ = nullptr;
  bool tcp_;
  int tuned_fd_ = -1;
  std::list<Subscription> subscriptions_;
};

}  // namespace genio
