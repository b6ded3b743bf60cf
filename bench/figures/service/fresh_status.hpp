#pragma once
#include "server/client.hpp"
#include "server/wire/wire.hpp"

namespace genio::bench {

/// A status that was made after it was asked for: every client hears those that others asked for,
/// and the one of each second. Nothing where none came in time.
inline std::optional<server_status_t> fresh_status(Client& client, double timeout_s) {
  const int64_t asked = now_us();
  for (;;) {
    auto status = client.status(timeout_s);
    if (!status || status->utime >= asked) return status;
  }
}

}  // namespace genio::bench
