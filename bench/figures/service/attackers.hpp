#pragma once
// Clients that mean harm.

#include <atomic>
#include <cstdint>
#include <thread>

#include "bench/figures/service/attacks.hpp"

namespace genio::bench {

/// Attacks the hub at a port of this host, in a thread of its own, until it is destroyed.
class Attackers {
 public:
  Attackers(const Attack& attack, uint16_t port);
  ~Attackers();
  Attackers(const Attackers&) = delete;
  Attackers& operator=(const Attackers&) = delete;

  /// Bytes that the hub took.
  uint64_t sent_bytes() const { return sent_; }

 private:
  void work();

  const Attack attack_;
  const uint16_t port_;
  std::atomic<bool> stop_{false};
  std::atomic<uint64_t> sent_{0};
  std::thread thread_;
};

}  // namespace genio::bench
