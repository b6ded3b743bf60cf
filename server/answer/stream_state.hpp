#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// Where a frame of a stream ended: the start of the next one that is asked alike.
struct StreamState {
  std::string prior = {};  ///< as the request has it: other priors have other unknowns
  Vector unknowns = {};    ///< empty: not known
  Positions shape = {};    ///< equilibrium of the unknowns [m]
};

/// As a block of bytes for another process of the same program; empty where nothing is known.
std::vector<uint8_t> state_bytes(const StreamState& state);
/// Throws std::runtime_error where the bytes are none.
StreamState stream_state(const std::vector<uint8_t>& bytes);

}  // namespace genio
