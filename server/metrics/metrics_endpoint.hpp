#pragma once
// Where a scraper fetches the figures of a service.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

namespace genio {

class MetricsLoop;

/// What clients of the endpoint may take. Tests use smaller ones.
struct MetricsLimits {
  size_t connections = 16;                  ///< a newcomer takes the place of the oldest
  std::chrono::milliseconds request{2000};  ///< from a connection's start to its whole request
  std::chrono::milliseconds whole{5000};    ///< to its end
};

/// Answers GET /metrics of HTTP/1 on 127.0.0.1 with the newest text that was published, from a
/// thread of its own. Each connection is for one request. It holds `connections` + 4 descriptors at
/// most, and nobody who asks, asks slowly or asks nothing changes anything for the service.
class MetricsEndpoint {
 public:
  /// Listens at once; port 0 chooses a free one. Throws InputError when the port is taken, and
  /// std::runtime_error when the system has no descriptor or thread left.
  explicit MetricsEndpoint(uint16_t port, const MetricsLimits& limits = {});
  ~MetricsEndpoint();
  MetricsEndpoint(const MetricsEndpoint&) = delete;
  MetricsEndpoint& operator=(const MetricsEndpoint&) = delete;

  uint16_t port() const { return port_; }
  /// What is answered from now on; before the first text it is 503. Never waits. For one thread.
  void publish(std::string text);

 private:
  std::unique_ptr<MetricsLoop> loop_;
  uint16_t port_;
  std::thread thread_;
};

}  // namespace genio
