#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/dispatch/waiting_line.hpp"
#include "server/wire/wire.hpp"

namespace genio {

/// A model that requests may name.
struct ModelIdentity {
  std::string name, hash;  ///< hash: 16 hexadecimal digits of its files
};

/// A request that was accepted, and what became of it. Times as of process_us(); 0: none.
struct RequestEntry {
  enum class State { waiting, running, answered } state = State::waiting;
  shape_request_t request;
  std::string digest;
  std::vector<std::string> clients;  ///< that asked; the first may withdraw it
  size_t model = 0, bytes = 0;
  WaitingRequest::Place place;  ///< in the line
  int64_t accepted = 0, deadline = 0, started = 0;
  int tries = 0;  ///< that took a worker with them
  bool resumed = false, cancelled = false;
  std::optional<command_reply_t> best;  ///< so far
  std::vector<uint8_t> reply;           ///< once it is answered

  bool asked_by(const std::string& client) const;
};

/// Puts into a reply what the request says of itself, who answered, and how long it took.
void stamp(const RequestEntry& entry, const ModelIdentity& model, int64_t now,
           command_reply_t& reply);

/// Which requests run one after another: those of one client, stream and model; empty: of none.
std::string stream_of(const RequestEntry& entry, const ModelIdentity& model);

}  // namespace genio
