#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "server/link/counts.hpp"

namespace genio {

/// What one kind of connection does for a Link, whose docs say what is promised.
class LinkTransport {
 public:
  using Handler = std::function<void(const std::string& channel, const void* data, size_t size)>;

  virtual ~LinkTransport() = default;
  virtual void subscribe(const std::string& channel, Handler handler) = 0;
  virtual bool publish(const std::string& channel, const std::vector<uint8_t>& bytes) = 0;
  virtual bool wait(int timeout_ms, std::span<const int> others) = 0;
  virtual bool connected() const = 0;
  virtual uint16_t local_port() const { return 0; }
  virtual std::optional<UdpmCounts> udpm_counts() const { return std::nullopt; }
};

}  // namespace genio
