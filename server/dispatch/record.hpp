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
  int64_t accepted, deadline;    ///< [us since 1970]; 0: no deadline
};
/// Its computation begins.
struct TriedRecord {
  std::string id;
};
/// It ended without an answer, as the server stops in good order.
struct UntriedRecord {
  std::string id;
};
struct AnsweredRecord {
  std::string id, status;
  std::vector<uint8_t> reply;
};
/// A client has the reply.
struct DeliveredRecord {
  std::string id;
};
using Record =
    std::variant<AcceptedRecord, TriedRecord, UntriedRecord, AnsweredRecord, DeliveredRecord>;

/// What is kept of an id that was used before.
struct KnownRequest {
  std::string digest;
  std::vector<uint8_t> reply;  ///< empty: not answered yet
};

}  // namespace genio
