#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace genio {

/// Why a datagram was dropped.
enum class UdpmDrop {
  not_lcm,      ///< shorter than a header, or with another mark
  fragment,     ///< LCM's own, in which LCM 1.3.1 believes any offset
  bad_channel,  ///< longer than LCM allows, or without an end
  foreign,      ///< from another host, where the URL says ttl=0
  bad_part,     ///< a part that does not decode or does not fit to the others
  count
};

/// What a connection over UDP multicast has done.
struct UdpmCounts {
  uint64_t datagrams_in = 0, datagrams_out = 0;
  uint64_t overflowed = 0;              ///< datagrams that found the receive buffer full
  uint64_t parts_in = 0;                ///< of messages that somebody here wants
  uint64_t repeated_parts = 0;          ///< of them: that were here already
  uint64_t joined = 0;                  ///< messages of several parts that came whole
  uint64_t wrong_digests = 0;           ///< whole ones that were not what they said
  uint64_t abandoned = 0, evicted = 0;  ///< unfinished ones: too old; for want of room
  uint64_t asks_in = 0, asks_out = 0;   ///< for missing parts
  uint64_t parts_out = 0, resent = 0;   ///< resent: of the former, for who asked
  uint64_t unsendable = 0;              ///< messages above the limit, or with a long channel
  std::array<uint64_t, size_t(UdpmDrop::count)> drops{};

  uint64_t& dropped(UdpmDrop why) { return drops[size_t(why)]; }
  uint64_t dropped(UdpmDrop why) const { return drops[size_t(why)]; }
};

}  // namespace genio
