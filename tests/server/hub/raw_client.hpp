#pragma once
// A client of the hub that may say anything, which LCM's own library does not.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/hub/descriptor.hpp"

namespace genio::test {

using std::chrono::milliseconds;

/// Asks again and again until it is true; false when it was not in time.
bool eventually(const std::function<bool()>& is_true, milliseconds longest = milliseconds(5000));

class RawClient {
 public:
  struct Message {
    std::string channel, payload;
  };

  /// A socket that is not connected; `receive_buffer` bytes wait in the system (0: as usual).
  explicit RawClient(int receive_buffer = 0);
  /// Connected and greeted.
  static RawClient greeted(uint16_t port, int receive_buffer = 0);

  /// False when nobody is there.
  bool connect(uint16_t port);
  /// False when the other side is gone, or took nothing for five seconds.
  bool send(std::string_view bytes);
  bool send(const std::vector<char>& bytes) { return send({bytes.data(), bytes.size()}); }
  /// Sends what is taken at once; how much it was, -1 when the other side is gone.
  ssize_t send_some(std::string_view bytes);
  bool greet();
  bool subscribe(std::string_view pattern);
  bool publish(std::string_view channel, std::string_view payload);

  /// The next message; nothing when none comes in time or the other side is gone.
  std::optional<Message> receive(milliseconds longest = milliseconds(5000));
  /// True once the other side has closed; what it sent before is thrown away.
  bool sees_the_end(milliseconds longest = milliseconds(5000));
  /// Reads once, at most that much, and throws it away.
  void sip(size_t bytes);
  void close() { socket_.reset(); }
  /// The port at this side.
  uint16_t port() const;

 private:
  bool fill(milliseconds longest);
  std::optional<Message> take();

  Descriptor socket_;
  std::string got_;
  bool ended_ = false;
};

}  // namespace genio::test
