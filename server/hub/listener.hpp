#pragma once
#include <cstdint>

#include "server/hub/descriptor.hpp"

namespace genio {

/// The socket at which a hub's connections arrive, on 127.0.0.1.
class HubListener {
 public:
  /// Listens at once; port 0 chooses a free one. Throws InputError when the port is taken.
  explicit HubListener(uint16_t port);

  enum class Outcome { accepted, nobody, turned_away, no_descriptor };
  struct Arrival {
    Outcome outcome;
    Descriptor socket = {};
    uint16_t port = 0;  ///< at the other side, if that is 127.0.0.1
  };
  /// The next connection, if one waits.
  Arrival accept();
  /// Where the process has no descriptor left: takes the next connection with one that is kept for
  /// this, and turns it away where there is no other by then, so that it does not wait in vain.
  Arrival accept_with_reserve();
  /// Nobody is taken any more, and who waits is refused.
  void close();

  int descriptor() const { return socket_.get(); }
  uint16_t port() const { return port_; }

 private:
  bool keep_reserve();

  Descriptor socket_, reserve_;
  uint16_t port_ = 0;
};

}  // namespace genio
