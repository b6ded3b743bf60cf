#pragma once
// Entries of which every byte follows from a number, so that a changed one is noticed.

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "server/journal/journal.hpp"

namespace genio::test {

inline std::vector<uint8_t> bytes_of(unsigned seed, size_t size) {
  std::mt19937 random(seed);
  std::vector<uint8_t> bytes(size);
  for (uint8_t& byte : bytes) byte = uint8_t(random());
  return bytes;
}

inline JournalEntry entry_of(unsigned k, size_t size = 6000) {
  JournalEntry e;
  e.id = "request-" + std::to_string(k), e.client = "client-" + std::to_string(k % 3);
  for (size_t i = 0; i < e.digest.size(); ++i) e.digest[i] = uint8_t(k >> 8 * (i % 4));
  e.model = "generic", e.stream = k % 2 ? "left" : "";
  e.priority = int(k % 5) - 2, e.deadline_us = 1000 * int64_t(k), e.accepted_us = 1'000'000 + k;
  e.request = bytes_of(k, size);
  return e;
}

inline std::vector<uint8_t> reply_of(unsigned k, size_t size = 10000) {
  return bytes_of(k + 1'000'000, size);
}

/// The entry as entry_of() made it, with its reply where it has one.
inline bool as_made(const JournalEntry& e, unsigned k, size_t request = 6000,
                    size_t reply = 10000) {
  const JournalEntry made = entry_of(k, request);
  const bool same = e.id == made.id && e.client == made.client && e.digest == made.digest &&
                    e.model == made.model && e.stream == made.stream &&
                    e.priority == made.priority && e.deadline_us == made.deadline_us &&
                    e.accepted_us == made.accepted_us && e.request == made.request;
  return same && (e.state == JournalState::accepted || e.reply == reply_of(k, reply));
}

}  // namespace genio::test
