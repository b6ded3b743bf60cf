#pragma once
// The protocol of LCM's tcpq transport, as lcm_tcpq.c of LCM 1.3 speaks it. It is made of words of
// 32 bits, the high byte first. Either side begins with two words, its mark and the version. After
// them a client sends
//
//     publish      1, length of the channel, channel, size of the payload, payload
//     subscribe    2, length of the pattern, pattern
//     unsubscribe  3, length of the pattern, pattern
//
// and the hub sends nothing but publish.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace genio::tcpq {

inline constexpr uint32_t server_mark = 0x287617fa, client_mark = 0x287617fb, version = 0x0100;
inline constexpr uint32_t publish = 1, subscribe = 2, unsubscribe = 3;
inline constexpr size_t word_bytes = 4, greeting_bytes = 2 * word_bytes;

/// The word that begins at `at`, of which all bytes must be there.
uint32_t word_at(const std::vector<char>& bytes, size_t at);

void append_word(std::vector<char>& bytes, uint32_t word);

/// A mark and the version.
std::vector<char> greeting(uint32_t mark);

/// A publication as it goes over the wire, in both directions alike.
std::vector<char> publication(std::string_view channel, std::string_view payload);

/// What a client sends to subscribe, or with `type` unsubscribe to end that.
std::vector<char> subscription(std::string_view pattern, uint32_t type = subscribe);

}  // namespace genio::tcpq
