#pragma once
// The messages that no computation makes.

#include <optional>
#include <string>
#include <vector>

#include "server/wire/wire.hpp"

namespace genio {

/// How a message passes records that are not kept yet.
enum class Passage {
  in_order,  ///< behind those before it
  at_once,   ///< it tells of none of them
  if_room,   ///< in order, and who misses it asks again: left out where much waits
};

/// A message that is to be published.
struct OutgoingMessage {
  std::string channel;
  std::vector<uint8_t> bytes;
  std::string acknowledges = {};  ///< id of the request that it says was taken
  Passage passage = Passage::in_order;
};

/// A reply without an answer. `retry_after_s`: when to ask again; 0: never the same.
command_reply_t reply_without_answer(const std::string& id, const char* status,
                                     const std::string& reason, double retry_after_s = 0);

/// True for what says more, or fits better and says as much.
bool says_more(const command_reply_t& a, const command_reply_t& b);

/// What a request gets at its deadline: the best so far, if there is any. `waited`: its turn never
/// came.
command_reply_t at_deadline(const std::string& id, const std::optional<command_reply_t>& best,
                            bool waited);

/// `rms` [m].
progress_t progress_of(const std::string& id, const char* stage, int iteration, double rms);

/// Replies to a client of an earlier version in the types that it knows, which say that it is too
/// old: all that have gone with that request. Empty where the fingerprint is of no earlier version.
std::vector<std::vector<uint8_t>> replies_of_earlier_versions(const void* request, size_t size,
                                                              const std::string& id);

}  // namespace genio
