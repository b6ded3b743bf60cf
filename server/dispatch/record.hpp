#pragma once
// What a journal keeps of a request's life, in the order in which it happens.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace genio {

struct AcceptedRecord {
  std::string id, client;
  std::string digest;            ///< see digest_of()
  std::vector<uint8_t> request;  ///< as it came
  int64_t accepted, deadline;    ///< [us], see later(); 0: no deadline
  std::string model = {}, stream = {};
  int priority = 0;
};
/// Its computation ended with the worker, and no answer.
struct LostRecord {
  std::string id;
};
struct AnsweredRecord {
  std::string id, status;
  std::vector<uint8_t> reply;
};
/// A client has the reply. `client`: counts only where that one asked first; empty: whoever it is.
struct DeliveredRecord {
  std::string id, client = {};
};
using Record = std::variant<AcceptedRecord, LostRecord, AnsweredRecord, DeliveredRecord>;

/// What is kept of an id that was used before.
struct KnownRequest {
  std::string digest;
  std::vector<uint8_t> reply;  ///< empty: not answered yet
};

}  // namespace genio
