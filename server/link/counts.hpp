#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "server/udpm/counts.hpp"

namespace genio {

/// What a connection has done.
struct LinkCounts {
  uint64_t failed_handlings = 0;   ///< messages whose handler threw an exception
  std::optional<UdpmCounts> udpm;  ///< where it goes over UDP multicast
};

/// A message whose handler threw an exception.
struct FailedHandling {
  std::string channel;
  size_t bytes = 0;
  std::string reason;
};

}  // namespace genio
