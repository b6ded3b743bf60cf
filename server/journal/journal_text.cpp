#include "server/journal/journal_text.hpp"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

namespace genio {
namespace {

using Json = nlohmann::ordered_json;

/// Bytes of the UTF-8 sign that begins at `at`, and its number; 0 where none does.
size_t utf8_sign(const std::string& text, size_t at, uint32_t& sign) {
  const auto byte = [&](size_t k) { return uint32_t(uint8_t(text[at + k])); };
  const uint32_t first = byte(0);
  const size_t length = first < 0x80       ? 1
                        : first >> 5 == 6  ? 2
                        : first >> 4 == 14 ? 3
                        : first >> 3 == 30 ? 4
                                           : 0;
  if (length == 0 || at + length > text.size()) return 0;
  sign = length == 1 ? first : first & (0x7fu >> length);
  for (size_t k = 1; k < length; ++k) {
    if (byte(k) >> 6 != 2) return 0;
    sign = sign << 6 | (byte(k) & 0x3f);
  }
  constexpr uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = sign >= 0xd800 && sign < 0xe000;
  return sign < smallest[length] || surrogate || sign > 0x10ffff ? 0 : length;
}

bool shown_as_it_is(uint32_t sign) {
  const bool control = sign < 0x20 || (sign >= 0x7f && sign < 0xa0);
  const bool steers = (sign >= 0x200b && sign <= 0x200f) || (sign >= 0x2028 && sign <= 0x202e) ||
                      (sign >= 0x2060 && sign <= 0x206f) || sign == 0xfeff;
  return !control && !steers;
}

Json time_json(int64_t us) { return us == 0 ? Json() : Json(utc_text(us, 6)); }

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string size_words(int64_t bytes) {
  return bytes < 1'000'000 ? fmt::format("{:.1f} kB", 1e-3 * double(bytes))
                           : fmt::format("{:.1f} MB", 1e-6 * double(bytes));
}

}  // namespace

std::string utc_text(int64_t us_since_1970, int digits) {
  using namespace std::chrono;
  constexpr int64_t first = -62'167'219'200'000'000, end = 253'402'300'800'000'000;
  if (us_since_1970 == 0) return "-";
  if (us_since_1970 < first || us_since_1970 >= end) return fmt::format("{} us", us_since_1970);
  const sys_time<microseconds> time{microseconds(us_since_1970)};
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  const int64_t fraction = clock.subseconds().count();
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:0{}}Z", int(date.year()),
                     unsigned(date.month()), unsigned(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(),
                     digits == 3 ? fraction / 1000 : fraction, digits);
}

std::string escaped_text(const std::string& bytes) {
  std::string text;
  for (size_t at = 0; at < bytes.size();) {
    uint32_t sign = 0;
    const size_t length = utf8_sign(bytes, at, sign);
    if (sign == '\\' && length == 1) text += "\\\\";
    else if (length > 0 && shown_as_it_is(sign)) text += bytes.substr(at, length);
    else
      for (size_t k = at; k < at + std::max<size_t>(length, 1); ++k)
        text += fmt::format("\\x{:02x}", uint8_t(bytes[k]));
    at += std::max<size_t>(length, 1);
  }
  return text;
}

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
