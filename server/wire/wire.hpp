#pragma once
// Messages as bytes. LCM's generated decoders believe the lengths they read; these do not.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "genio/ack_t.hpp"
#include "genio/cancel_t.hpp"
#include "genio/command_reply_t.hpp"
#include "genio/part_ask_t.hpp"
#include "genio/part_t.hpp"
#include "genio/progress_t.hpp"
#include "genio/sealed_t.hpp"
#include "genio/server_status_t.hpp"
#include "genio/shape_request_t.hpp"

namespace genio {

inline constexpr size_t max_message_bytes = 4u << 20;
inline constexpr int max_array_length = 20000;
inline constexpr int max_string_length = 1 << 16;  ///< bytes

/// Fields of a message in order: l int64, i int32, b int8 or byte, d double, s string, n int32 that
/// counts the arrays after it, D double[n], I int32[n], S string[n], B byte[n]. Bytes are counted
/// by m, which may be as large as a message, in the place of n. A fixed array is written out.
template <class T>
struct WireLayout;
template <>
struct WireLayout<shape_request_t> {
  static constexpr const char* fields = "lsssssdissddddddnDDnDDDDSddbi";
};
template <>
struct WireLayout<command_reply_t> {
  static constexpr const char* fields =
      "lssssssdssdsnSDDDDDDDDDdinSSDDDDnISDnSnSDDDdddiiddisddddddnDDdnDDnD";
};
template <>
struct WireLayout<progress_t> {
  static constexpr const char* fields = "lssid";
};
template <>
struct WireLayout<cancel_t> {
  static constexpr const char* fields = "lss";
};
template <>
struct WireLayout<ack_t> {
  static constexpr const char* fields = "lss";
};
template <>
struct WireLayout<server_status_t> {
  static constexpr const char* fields = "lsnSSiiillllllllllllllddddd";
};
template <>
struct WireLayout<part_t> {
  static constexpr const char* fields = "lssiimB";
};
template <>
struct WireLayout<part_ask_t> {
  static constexpr const char* fields = "lsnI";
};
template <>
struct WireLayout<sealed_t> {
  static constexpr const char* fields =
      "l"
      "bbbbbbbbbbbbbbbb"
      "smB"
      "bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb";
};

/// Of one message. What a seal holds may be as large as a message without one.
template <class T>
inline constexpr size_t most_bytes = max_message_bytes;
template <>
inline constexpr size_t most_bytes<sealed_t> = max_message_bytes + 1024;

/// Walks the bytes after the fingerprint along `fields`; empty when they fit exactly, else what is
/// wrong.
std::string scan_layout(const uint8_t* data, size_t size, const char* fields);

/// Decodes after checking fingerprint, lengths and that every byte is used; `why` says what is
/// wrong otherwise.
template <class T>
std::optional<T> decode_checked(const void* data, size_t size, std::string& why) {
  const auto* bytes = static_cast<const uint8_t*>(data);
  if (size > most_bytes<T>) return why = "the message is too large", std::nullopt;
  if (size < 8) return why = "the message is shorter than a fingerprint", std::nullopt;
  int64_t hash = 0;
  for (int i = 0; i < 8; ++i) hash = int64_t(uint64_t(hash) << 8 | bytes[i]);
  if (hash != T::getHash())
    return why =
               std::string("not a ") + T::getTypeName() + " of this version (fingerprint differs)",
           std::nullopt;
  why = scan_layout(bytes + 8, size - 8, WireLayout<T>::fields);
  if (!why.empty()) return std::nullopt;
  try {
    T message;
    if (message.decode(data, 0, int(size)) == int(size)) return message;
    why = "the message does not decode";
  } catch (const std::exception& e) {
    why = e.what();
  }
  return std::nullopt;
}

template <class T>
std::vector<uint8_t> encode(const T& message) {
  std::vector<uint8_t> bytes(size_t(message.getEncodedSize()));
  message.encode(bytes.data(), 0, int(bytes.size()));
  return bytes;
}

/// Microseconds since 1970.
int64_t now_us();

}  // namespace genio
