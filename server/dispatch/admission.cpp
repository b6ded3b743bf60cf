#include "server/dispatch/admission.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace genio {
namespace {

constexpr size_t longest_kind = 64;
constexpr int most_starts = 1000, most_priority = 10;
constexpr size_t before_id = 16;  // bytes: the fingerprint and the time

/// Reads one string of a message at `at`; nothing where it is none.
std::optional<std::string> string_at(const uint8_t* bytes, size_t size, size_t& at) {
  if (size - at < 4) return {};
  const size_t length = size_t(bytes[at]) << 24 | size_t(bytes[at + 1]) << 16 |
                        size_t(bytes[at + 2]) << 8 | size_t(bytes[at + 3]);
  at += 4;
  if (length < 1 || length > longest_id + 1 || length > size - at || bytes[at + length - 1] != 0)
    return {};
  const std::string text(reinterpret_cast<const char*>(bytes + at), length - 1);
  at += length;
  return text;
}

bool printable(const std::string& text) {
  return std::none_of(text.begin(), text.end(),
                      [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

}  // namespace

bool usable_client(const std::string& name) {
  return !name.empty() && name.size() <= 40 &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

std::string fault_of_frame(const shape_request_t& r) {
  if (!r.frame.empty() && r.frame != "model" && r.frame != "device" && r.frame != "placed")
    return "frame: expected 'model', 'device' or 'placed'";
  if (r.frame != "device" && r.palate_count > 0)
    return "palate_x_mm: a palate is for points in the frame 'device'";
  if (r.frame == "placed" && !(r.scale > 0 && std::isfinite(r.scale)))
    return "scale must be above 0 in the frame 'placed'";
  for (const auto& [name, value] : {std::pair("tilt_deg", r.tilt_deg),
                                    {"shift_x_mm", r.shift_x_mm},
                                    {"shift_z_mm", r.shift_z_mm}})
    if (r.frame == "placed" && !std::isfinite(value))
      return fmt::format("{} must be finite in the frame 'placed'", name);
  for (const auto* palate : {&r.palate_x_mm, &r.palate_z_mm})
    for (size_t k = 0; k < palate->size(); ++k)
      if (!std::isfinite((*palate)[k]))
        return fmt::format("palate point {}: palate_x_mm and palate_z_mm must be finite", k + 1);
  return "";
}

std::string fault_of(const shape_request_t& r) {
  if (!usable_client(r.client)) return "client: expected 1 to 40 letters, digits, '_' or '-'";
  if (r.id.empty() || r.id.size() > longest_id || !printable(r.id))
    return fmt::format("id: expected 1 to {} characters, none of them a control character",
                       longest_id);
  for (const auto& [name, text] : {std::pair("model", &r.model), {"label", &r.label}})
    if (text->size() > longest_id || !printable(*text))
      return fmt::format("{}: expected at most {} characters, none of them a control character",
                         name, longest_id);
  if (!r.stream.empty() && !usable_client(r.stream))
    return "stream: expected at most 40 letters, digits, '_' or '-'";
  if (r.priority < -most_priority || r.priority > most_priority)
    return fmt::format("priority must be -{0} to {0}", most_priority);
  if (const std::string fault = fault_of_frame(r); !fault.empty()) return fault;
  for (size_t k = 0; k < r.kind.size(); ++k)
    if (r.kind[k].size() > longest_kind)
      return fmt::format("point {}: kind has {} characters; expected at most {}", k + 1,
                         r.kind[k].size(), longest_kind);
  if (!std::isfinite(r.default_sigma_mm) || r.default_sigma_mm < 0)
    return "default_sigma_mm must be 0 or above";
  if (!std::isfinite(r.deadline_s) || r.deadline_s < 0) return "deadline_s must be 0 or above";
  if (r.bilateral < -1 || r.bilateral > 1) return "bilateral must be -1, 0 or 1";
  if (r.starts < 0 || r.starts > most_starts)
    return fmt::format("starts must be 0 to {}", most_starts);
  return "";
}

std::optional<Sender> sender_of(const void* data, size_t size) {
  const auto* bytes = static_cast<const uint8_t*>(data);
  if (size < before_id) return {};
  size_t at = before_id;
  const auto id = string_at(bytes, size, at);
  const auto client = id ? string_at(bytes, size, at) : std::nullopt;
  if (!client || !usable_client(*client) || !printable(*id)) return {};
  return Sender{*id, *client};
}

std::string digest_of(shape_request_t request) {
  request.utime = 0, request.client.clear();
  const auto bytes = encode(request);
  std::string digest(crypto_generichash_BYTES, '\0');
  crypto_generichash(reinterpret_cast<unsigned char*>(digest.data()), digest.size(), bytes.data(),
                     bytes.size(), nullptr, 0);
  return digest;
}

}  // namespace genio
