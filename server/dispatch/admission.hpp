#pragma once
// Whether a request can be taken at all, before anything of it is kept.

#include <optional>
#include <string>

#include "server/wire/wire.hpp"

namespace genio {

/// Where replies go to that nobody can be told of.
inline constexpr const char* unknown_client = "undecodable";

inline constexpr size_t longest_id = 200;

/// True for 1 to 40 letters, digits, '_' or '-'.
bool usable_client(const std::string& name);

/// What is wrong with the request, in words that name the field; empty where nothing is. What its
/// points mean is the model's to say.
std::string fault_of(const shape_request_t& request);

/// The same of the frame alone: its name, its place and its palate.
std::string fault_of_frame(const shape_request_t& request);

/// Who sent a message of which only the beginning can be read, and under which id. All versions of
/// the request begin alike.
struct Sender {
  std::string id, client;
};
std::optional<Sender> sender_of(const void* data, size_t size);

/// Of a request without what each sending changes: the same question, the same digest.
std::string digest_of(shape_request_t request);

}  // namespace genio
