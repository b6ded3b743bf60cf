#pragma once
// What clients that mean harm do, for the figure of what an honest one notices.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "genio/shape_request_t.hpp"

namespace genio::bench {

/// What one of them does.
struct Attack {
  std::string name;
  int connections = 20;
  bool greets = true;
  bool reads = false;       ///< takes what comes; else its buffers fill
  bool leaves = false;      ///< closes and connects again after a message
  bool subscribes = false;  ///< to all channels
  /// The next bytes that a connection sends; empty: it sends nothing.
  std::function<std::string(uint64_t number)> bytes;
};

/// All that are tried: idle and half-open connections, patterns, readers that take nothing, floods
/// of several sizes on channels of others and of the service, and messages that are wrong.
/// `question`: a request that is right.
std::vector<Attack> all_attacks(const shape_request_t& question);

}  // namespace genio::bench
