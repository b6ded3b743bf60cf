#include "server/hub/protocol/tcpq.hpp"

namespace genio::tcpq {
namespace {

void append_text(std::vector<char>& bytes, std::string_view text) {
  append_word(bytes, uint32_t(text.size()));
  bytes.insert(bytes.end(), text.begin(), text.end());
}

}  // namespace

uint32_t word_at(const std::vector<char>& bytes, size_t at) {
  uint32_t word = 0;
  for (size_t i = at; i < at + word_bytes; ++i) word = word << 8 | uint8_t(bytes[i]);
  return word;
}

void append_word(std::vector<char>& bytes, uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(char(word >> shift & 0xff));
}

std::vector<char> greeting(uint32_t mark) {
  std::vector<char> bytes;
  append_word(bytes, mark);
  append_word(bytes, version);
  return bytes;
}

std::vector<char> publication(std::string_view channel, std::string_view payload) {
  std::vector<char> bytes;
  append_word(bytes, publish);
  append_text(bytes, channel);
  append_text(bytes, payload);
  return bytes;
}

std::vector<char> subscription(std::string_view pattern, uint32_t type) {
  std::vector<char> bytes;
  append_word(bytes, type);
  append_text(bytes, pattern);
  return bytes;
}

}  // namespace genio::tcpq
