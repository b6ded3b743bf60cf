#pragma once
#include <cstddef>

namespace genio {

/// What is kept for clients at most. A quarter more may wait of clients of whom few wait.
struct DispatchLimits {
  int waiting = 256;                    ///< requests; more are refused with a reply
  size_t waiting_bytes = 32u << 20;     ///< of them all, as they came
  size_t clients = 16;                  ///< that wait for one and the same request
  double longest_s = 600;               ///< that a request computes
  int remembered = 1024;                ///< replies kept for repeated ids
  size_t remembered_bytes = 16u << 20;  ///< of them all
  size_t streams = 1024;                ///< whose last shape is kept for their next frame
  size_t streams_bytes = 32u << 20;     ///< of them all
};

}  // namespace genio
