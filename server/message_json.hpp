#pragma once
// Messages as JSON, for people and other programs.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace genio {

/// All fields of a shape_request_t, in their order, as one line; what is no number is null.
/// Nothing, with `why`, where the bytes are no such message.
std::optional<std::string> request_json(const std::vector<uint8_t>& bytes, std::string& why);

/// The same of a command_reply_t.
std::optional<std::string> reply_json(const std::vector<uint8_t>& bytes, std::string& why);

}  // namespace genio
