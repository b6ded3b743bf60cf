#pragma once
// What a client of the hub says, or the hub to a client, out of the bytes that come.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "server/hub/protocol/tcpq.hpp"

namespace genio {

/// One whole thing that a client said, or a hub.
struct HubEvent {
  enum class Kind { greeting, publish, subscribe, unsubscribe };
  Kind kind = Kind::greeting;
  std::vector<char> frame;  ///< all its bytes as they came; a publication is passed on like this
  size_t name_bytes = 0;

  /// The channel, or the pattern of channels; empty for a greeting.
  std::string_view name() const;
  /// Of a publication; empty for all else.
  std::string_view payload() const;
};

/// Cuts the bytes of the other side into events. It needs no socket, and takes no more memory than
/// four times the bytes that really came, whatever lengths they claim.
class HubParser {
 public:
  enum class Fault {
    none,
    malformed,    ///< no greeting of LCM, or no type of message
    too_large,    ///< a payload or a channel above its limit
    long_pattern  ///< a pattern above the limit of channels
  };

  /// `mark`: with which the other side greets.
  HubParser(size_t max_name_bytes, size_t max_payload_bytes, uint32_t mark = tcpq::client_mark)
      : max_name_(max_name_bytes), max_payload_(max_payload_bytes), mark_(mark) {}

  /// Takes bytes from the front of `bytes` until an event is whole, and leaves the rest for the
  /// next call. Nothing when all bytes are taken and none is whole, or once there is a fault.
  /// Throws std::bad_alloc; what it had taken is then of no more use.
  std::optional<HubEvent> next(std::string_view& bytes);

  Fault fault() const { return fault_; }
  bool greeted() const { return greeted_; }
  /// True while an event has begun and is not whole.
  bool partial() const { return !frame_.empty(); }
  /// Memory that the unfinished event takes [bytes].
  size_t held() const { return frame_.capacity(); }
  /// Gives that memory back; nothing more can be parsed.
  void abandon();

 private:
  size_t needed();
  size_t needed_of_publication(size_t name_end);
  void take(std::string_view& bytes, size_t needed);
  HubEvent finish();

  size_t max_name_, max_payload_;
  uint32_t mark_;
  std::vector<char> frame_;
  bool greeted_ = false;
  Fault fault_ = Fault::none;
};

}  // namespace genio
