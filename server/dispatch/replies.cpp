#include "server/dispatch/replies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

/// A reply type of an earlier version, and the request that came with it: fingerprints as LCM puts
/// them before a message, and the reply's fields as in WireLayout.
struct EarlierVersion {
  uint64_t request, reply;
  const char* fields;
};

/// LCM turns the hash of a type without members of other types by one bit.
constexpr uint64_t fingerprint(uint64_t hash) { return hash << 1 | hash >> 63; }

constexpr EarlierVersion earlier_versions[] = {
    {fingerprint(0x95a7b6730632514f), fingerprint(0xa9cf6e5a3c1e0e8b), "lssssnSDDDDnSdddiidnDD"},
    {fingerprint(0x04b683c0d110b74b), fingerprint(0xc007014abc122fa2),
     "lssssnSDDDDnSdddiidnDDdnDDnD"},
    {fingerprint(0x04b683c0d110b74b), fingerprint(0xea3536de8461009f),
     "lssssnSDDDDDDDDnSnSDDDdddiidnDDdnDDnD"},
};

void append(std::vector<uint8_t>& bytes, uint64_t value, int count) {
  for (int k = count - 1; k >= 0; --k) bytes.push_back(uint8_t(value >> 8 * k));
}

void append(std::vector<uint8_t>& bytes, const std::string& text) {
  append(bytes, text.size() + 1, 4);
  bytes.insert(bytes.end(), text.begin(), text.end());
  bytes.push_back(0);
}

/// A reply of that layout whose first strings are given, and all else zero or empty.
std::vector<uint8_t> blank_reply(const EarlierVersion& version,
                                 const std::vector<std::string>& strings) {
  std::vector<uint8_t> bytes;
  append(bytes, version.reply, 8);
  size_t told = 0;
  for (const char* f = version.fields; *f; ++f) switch (*f) {
      case 's':
        append(bytes, strings.at(told++));
        break;
      case 'l':
      case 'd':
        append(bytes, *f == 'l' ? uint64_t(now_us()) : 0, 8);
        break;
      case 'i':
      case 'n':
        append(bytes, 0, 4);
        break;
      default:  // arrays of no entries
        break;
    }
  return bytes;
}

bool has_intervals(const command_reply_t& r) {
  return std::any_of(r.low_N.begin(), r.low_N.end(), [](double low) { return !std::isnan(low); });
}

}  // namespace

command_reply_t reply_without_answer(const std::string& id, const char* status,
                                     const std::string& reason, double retry_after_s) {
  command_reply_t reply{};
  reply.id = id, reply.status = status, reply.verdict = "none", reply.message = reason;
  reply.utime = now_us(), reply.version = GENIO_VERSION, reply.retry_after_s = retry_after_s;
  for (double* unknown :
       {&reply.mirrored, &reply.time_s, &reply.scale, &reply.tilt_deg, &reply.shift_x_mm,
        &reply.shift_z_mm, &reply.shift_sd_mm, &reply.tilt_sd_deg})
    *unknown = std::nan("");
  return reply;
}

bool says_more(const command_reply_t& a, const command_reply_t& b) {
  return has_intervals(a) != has_intervals(b) ? has_intervals(a) : a.rms_mm < b.rms_mm;
}

command_reply_t at_deadline(const std::string& id, const std::optional<command_reply_t>& best,
                            bool waited) {
  if (!best)
    return reply_without_answer(id, "deadline",
                                waited ? "the deadline passed while the request waited for its turn"
                                       : "the deadline passed before the first step was done");
  command_reply_t reply = *best;
  reply.id = id, reply.status = "deadline";
  reply.message = has_intervals(reply)
                      ? "the deadline passed before all starts were done"
                      : "the deadline passed; this is the best shape so far, without intervals";
  return reply;
}

progress_t progress_of(const std::string& id, const char* stage, int iteration, double rms) {
  progress_t p{};
  p.utime = now_us(), p.id = id, p.stage = stage;
  p.iteration = iteration, p.rms_mm = 1e3 * rms;
  return p;
}

std::vector<std::vector<uint8_t>> replies_of_earlier_versions(const void* request, size_t size,
                                                              const std::string& id) {
  std::vector<std::vector<uint8_t>> replies;
  if (size < 8) return replies;
  uint64_t came = 0;
  for (int k = 0; k < 8; ++k) came = came << 8 | static_cast<const uint8_t*>(request)[k];
  const std::string reason = fmt::format(
      "this server is genio {}, whose messages are newer than the client's; take the client's "
      "message types from this version",
      GENIO_VERSION);
  for (const EarlierVersion& version : earlier_versions)
    if (version.request == came)
      replies.push_back(blank_reply(version, {id, "failed", reason, "none"}));
  return replies;
}

}  // namespace genio
