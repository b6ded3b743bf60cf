#pragma once
#include "inverse/prior/prior.hpp"
#include "server/wire/wire.hpp"

namespace genio {

/// The prior that a request brings as text, read as prior files are, else the usual one. It may
/// name no file. Throws InputError as in "prior, line 3: ...".
Prior prior_of(const Model& model, const shape_request_t& request);

}  // namespace genio
