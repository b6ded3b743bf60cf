#pragma once
// A request in the journal, with what became of it.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace genio {

/// Tells contents of requests apart; made by whoever accepts them, by SHA-256 for example.
using ContentDigest = std::array<uint8_t, 32>;

enum class JournalState {
  accepted,   ///< not answered yet
  answered,   ///< the reply is kept; nobody has said that it arrived
  delivered,  ///< the client acknowledged the reply
};

const char* to_string(JournalState state);

/// Times are wall times [us since 1970], and 0 where there is none. Texts may hold any bytes.
struct JournalEntry {
  // What the server accepts:
  std::string id;      ///< no two entries have the same
  std::string client;  ///< who asked
  ContentDigest digest{};
  std::string model, stream;
  int priority = 0;
  int64_t deadline_us = 0;
  int64_t accepted_us = 0;
  std::vector<uint8_t> request;  ///< empty where the entry was read without it

  // What the journal adds:
  int64_t number = 0;  ///< entries are numbered as they are accepted; a number is given once
  JournalState state = JournalState::accepted;
  int tries = 0;  ///< that ended without an answer
  int64_t answered_us = 0, delivered_us = 0;
  std::string status;          ///< of the reply
  std::vector<uint8_t> reply;  ///< empty where the entry was read without it
  int64_t request_bytes = 0, reply_bytes = 0;
};

/// Whether entries are read with request and reply, or without, which is cheaper.
enum class Blobs { without, with };

struct JournalCounts {
  int64_t accepted = 0, answered = 0, delivered = 0;  ///< entries in each state
  int64_t file_bytes = 0;  ///< without what waits in the write-ahead log beside the file
  int64_t free_bytes = 0;  ///< of those, what the next entries may use
};

}  // namespace genio
