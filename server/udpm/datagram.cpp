#include "server/udpm/datagram.hpp"

#include <algorithm>
#include <iterator>

namespace genio {
namespace {

constexpr uint32_t short_mark = 0x4c433032, fragment_mark = 0x4c433033;  // LC02, LC03

void append_big_endian(std::vector<uint8_t>& bytes, uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(uint8_t(word >> shift));
}

}  // namespace

std::optional<UdpmDatagram> read_datagram(std::span<const uint8_t> bytes, UdpmDrop& why) {
  why = UdpmDrop::not_lcm;
  if (bytes.size() < udpm_header_bytes) return std::nullopt;
  const uint32_t mark = uint32_t(bytes[0]) << 24 | uint32_t(bytes[1]) << 16 |
                        uint32_t(bytes[2]) << 8 | uint32_t(bytes[3]);
  if (mark == fragment_mark) why = UdpmDrop::fragment;
  if (mark != short_mark) return std::nullopt;
  const auto rest = bytes.subspan(udpm_header_bytes);
  const auto begin = rest.begin();
  const auto last = begin + ptrdiff_t(std::min(rest.size(), udpm_longest_channel + 1));
  const auto zero = std::find(begin, last, uint8_t(0));
  why = UdpmDrop::bad_channel;
  if (zero == last) return std::nullopt;
  const auto length = size_t(zero - begin);
  return UdpmDatagram{{reinterpret_cast<const char*>(rest.data()), length},
                      rest.subspan(length + 1)};
}

std::vector<uint8_t> make_datagram(uint32_t number, std::string_view channel,
                                   std::span<const uint8_t> payload) {
  std::vector<uint8_t> bytes;
  bytes.reserve(datagram_bytes(channel, payload.size()));
  append_big_endian(bytes, short_mark);
  append_big_endian(bytes, number);
  bytes.insert(bytes.end(), channel.begin(), channel.end());
  bytes.push_back(0);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

size_t datagram_bytes(std::string_view channel, size_t payload_bytes) {
  return udpm_header_bytes + channel.size() + 1 + payload_bytes;
}

}  // namespace genio
