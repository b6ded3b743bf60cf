#include "server/journal/journal_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "server/base/safe_text.hpp"

namespace genio {
namespace {

using Json = nlohmann::ordered_json;

Json time_json(int64_t us) { return us == 0 ? Json() : Json(utc_text(us, 6)); }

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string size_words(int64_t bytes) {
  return bytes < 1'000'000 ? fmt::format("{:.1f} kB", 1e-3 * double(bytes))
                           : fmt::format("{:.1f} MB", 1e-6 * double(bytes));
}

}  // namespace

std::string list_header() {
  return "number\tid\tclient\tstate\tstatus\taccepted\tanswered\tdelivered\ttries\trequest_bytes\t"
         "reply_bytes";
}

std::string list_line(const JournalEntry& e, const std::string& damage) {
  const std::string line = fmt::format(
      "{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}", e.number, escaped_text(e.id),
      escaped_text(e.client), to_string(e.state), e.status.empty() ? "-" : escaped_text(e.status),
      utc_text(e.accepted_us, 3), utc_text(e.answered_us, 3), utc_text(e.delivered_us, 3), e.tries,
      e.request_bytes, e.reply_bytes);
  return damage.empty() ? line : line + "\tdamaged: " + escaped_text(damage);
}

std::string counts_line(const JournalCounts& counts) {
  return fmt::format("{} accepted, {} answered, {} delivered; {}, of which {} are free",
                     counts.accepted, counts.answered, counts.delivered,
                     size_words(counts.file_bytes), size_words(counts.free_bytes));
}

std::string entry_json(const JournalEntry& e, const std::string& damage) {
  std::string digest;
  for (const uint8_t byte : e.digest) digest += fmt::format("{:02x}", byte);
  Json json = {{"number", e.number},
               {"id", e.id},
               {"client", e.client},
               {"state", to_string(e.state)},
               {"status", e.status.empty() ? Json() : Json(e.status)},
               {"accepted", time_json(e.accepted_us)},
               {"answered", time_json(e.answered_us)},
               {"delivered", time_json(e.delivered_us)},
               {"deadline", time_json(e.deadline_us)},
               {"tries", e.tries},
               {"priority", e.priority},
               {"model", e.model},
               {"stream", e.stream},
               {"digest", digest},
               {"request_bytes", e.request_bytes},
               {"reply_bytes", e.reply_bytes}};
  if (!damage.empty()) json["damage"] = damage;
  return dumped(json);
}

std::string pruned_line(const Pruned& pruned, const JournalCounts& left) {
  return fmt::format("removed {} delivered and {} answered entries ({}); left: {}",
                     pruned.delivered, pruned.answered, size_words(pruned.bytes),
                     counts_line(left));
}

std::string pruned_json(const Pruned& pruned, const JournalCounts& left) {
  return dumped({{"removed_delivered", pruned.delivered},
                 {"removed_answered", pruned.answered},
                 {"removed_bytes", pruned.bytes},
                 {"accepted", left.accepted},
                 {"answered", left.answered},
                 {"delivered", left.delivered},
                 {"file_bytes", left.file_bytes},
                 {"free_bytes", left.free_bytes}});
}

}  // namespace genio
