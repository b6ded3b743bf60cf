// Messages from the network.

#include <algorithm>
#include <cmath>

#include "forward/base/types.hpp"
#include "server/dispatch/admission.hpp"
#include "server/dispatch/replies.hpp"
#include "server/message_json.hpp"
#include "server/metrics/http_request.hpp"
#include "server/udpm/datagram.hpp"
#include "server/wire/wire.hpp"
#include "tests/fuzz/dispatch_script.hpp"
#include "tests/fuzz/fuzz_reader.hpp"
#include "tests/fuzz/fuzz_script.hpp"
#include "tests/fuzz/parts_script.hpp"

namespace genio::test {
namespace {

using Bytes = std::vector<uint8_t>;

template <class T>
std::string text_of(const T& message) {
  const Bytes bytes = encode(message);
  return {bytes.begin(), bytes.end()};
}

shape_request_t sample_request() {
  shape_request_t r{};
  r.id = "a", r.client = "c", r.point_count = 2;
  r.x_mm = {1, 2}, r.y_mm = {0, 0}, r.z_mm = {3, 4}, r.sigma_mm = {0, 0}, r.kind = {"curve", "tip"};
  return r;
}

shape_request_t sample_device_request() {
  shape_request_t r = sample_request();
  r.frame = "device", r.stream = "s", r.label = "a", r.model = "adult", r.prior = "effort_sd = 1\n";
  r.palate_count = 1, r.palate_x_mm = {1}, r.palate_z_mm = {2};
  return r;
}

std::string sample_part() {
  part_t part{};
  part.channel = "GENIO_REQUEST", part.message = std::string(32, '0'), part.count = 2;
  part.size = 3, part.data = {1, 2, 3};
  return text_of(part);
}

std::string sample_part_ask() {
  part_ask_t ask{};
  ask.message = std::string(32, 'f'), ask.count = 2, ask.index = {0, 1};
  return text_of(ask);
}

std::string sample_sealed() {
  sealed_t s{};
  s.channel = "GENIO_ACK", s.body = encode(ack_t{}), s.size = int(s.body.size());
  return text_of(s);
}

/// A request of version 0.4.0, which begins as all do.
std::string old_request() {
  return {"\x09\x6d\x07\x81\xa2\x21\x6e\x96\0\0\0\0\0\0\0\0\0\0\0\2a\0\0\0\0\2c\0", 28};
}

bool is_one_line(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; });
}

/// What is decoded is what was sent, bit by bit. Decoded again it may not depend on what a message
/// held before.
template <class T>
std::optional<T> decode_and_compare(const Bytes& bytes, std::string& why) {
  auto message = decode_checked<T>(bytes.data(), bytes.size(), why);
  hold(message.has_value() == why.empty(),
       "a message is refused without a reason, or read with one");
  if (message) hold(encode(*message) == bytes, "encoded again, a message differs");
  return message;
}

void admit(const shape_request_t& request, const Bytes& bytes) {
  std::string why;
  const auto json = request_json(bytes, why);
  hold(json && is_one_line(*json), "a request is no line of JSON");
  const std::string digest = digest_of(request);
  shape_request_t sent_again = request, other = request;
  sent_again.utime += 1, sent_again.client += "x", other.starts ^= 1;
  hold(digest_of(sent_again) == digest && digest_of(other) != digest,
       "a digest is of something else than the question");
  const std::string fault = fault_of(request);
  hold(is_one_line(fault) && fault.size() < 1000, "a fault is not told in a line");
  if (!fault.empty()) return;
  const auto sender = sender_of(bytes.data(), bytes.size());
  hold(sender && sender->id == request.id && sender->client == request.client,
       "who sent a good request is not known");
  hold(request.priority >= -10 && request.priority <= 10 && request.starts >= 0 &&
           request.deadline_s >= 0 && std::isfinite(request.deadline_s),
       "a number out of its range is admitted");
  hold(!request.id.empty() && request.id.size() <= longest_id && usable_client(request.client),
       "a name that is none is admitted");
}

/// True where the bytes are a message of some type. `why` says of each other one why not.
bool is_message(const Bytes& bytes, std::string& why) {
  if (const auto request = decode_and_compare<shape_request_t>(bytes, why))
    return admit(*request, bytes), true;
  if (decode_and_compare<command_reply_t>(bytes, why)) {
    const auto json = reply_json(bytes, why);
    hold(json && is_one_line(*json), "a reply is no line of JSON");
    return true;
  }
  return decode_and_compare<progress_t>(bytes, why) || decode_and_compare<cancel_t>(bytes, why) ||
         decode_and_compare<ack_t>(bytes, why) || decode_and_compare<server_status_t>(bytes, why) ||
         decode_and_compare<part_t>(bytes, why) || decode_and_compare<part_ask_t>(bytes, why) ||
         decode_and_compare<sealed_t>(bytes, why);
}

void read_message(const std::string& path) {
  const std::string text = bytes_of_file(path);
  const Bytes bytes(text.begin(), text.end());
  const auto sender = sender_of(bytes.data(), bytes.size());
  hold(!sender || (usable_client(sender->client) && sender->id.size() <= longest_id),
       "a sender's name is none");
  const auto old =
      replies_of_earlier_versions(bytes.data(), bytes.size(), sender ? sender->id : "");
  std::string why;
  const bool message = is_message(bytes, why);
  hold(!message || old.empty(), "a message is of this version and of another");
  for (const Bytes& reply : old) hold(reply.size() > 8, "a reply to an earlier version is empty");
  if (!message && old.empty()) throw InputError(why);
}

FuzzReader datagram_reader() {
  const std::string payload = "bytes";
  const Bytes sample =
      make_datagram(7, "GENIO_REQUEST", {reinterpret_cast<const uint8_t*>(payload.data()), 5});
  return {"datagram", "datagram", {{sample.begin(), sample.end()}}, [](const std::string& path) {
            const std::string text = bytes_of_file(path);
            const Bytes bytes(text.begin(), text.end());
            UdpmDrop why = UdpmDrop::count;
            const auto read = read_datagram(bytes, why);
            if (!read) throw InputError("no datagram");
            hold(read->channel.size() <= udpm_longest_channel, "a channel is too long");
            Bytes again = make_datagram(0, read->channel, read->payload);
            std::copy_n(bytes.begin() + 4, 4, again.begin() + 4);  // its number
            hold(again == bytes, "a datagram is read as another");
          }};
}

FuzzReader http_reader() {
  return {"http",
          "request",
          {"GET /metrics HTTP/1.1\r\nHost: 127.0.0.1:9100\r\nAccept: */*\r\n\r\n",
           "HEAD /metrics HTTP/1.0\r\nHost: localhost\r\n\r\n", "GET /metrics HTTP/1.0\r\n\r\n"},
          [](const std::string& path) {
            const std::string text = bytes_of_file(path), metrics = "a 1\n";
            const HttpVerdict verdict = judge_http(text);
            for (size_t size = 0; size < text.size() && text.size() < 600; ++size) {
              const HttpVerdict before = judge_http(std::string_view(text).substr(0, size));
              hold(before.answer == HttpAnswer::not_yet || before.answer == verdict.answer,
                   "more bytes change an answer that was given");
            }
            if (verdict.answer != HttpAnswer::not_yet) {
              hold(http_response(verdict, &metrics).starts_with("HTTP/1."), "no response");
              hold(http_response(verdict, nullptr).starts_with("HTTP/1."), "no response");
            }
            if (verdict.answer != HttpAnswer::metrics) throw InputError("no scraper's request");
          }};
}

}  // namespace

std::vector<FuzzReader> wire_readers() {
  return {
      {"wire",
       "message",
       {text_of(sample_request()), text_of(sample_device_request()), old_request(),
        text_of(command_reply_t{}), text_of(progress_t{}), text_of(cancel_t{}), text_of(ack_t{}),
        text_of(server_status_t{}), sample_part(), sample_part_ask(), sample_sealed()},
       read_message},
      datagram_reader(),
      {"parts",
       "script",
       {sample_parts_script()},
       [](const std::string& path) { play_parts_script(bytes_of_file(path)); }},
      http_reader(),
      {"dispatch", "script", sample_dispatch_scripts(),
       [](const std::string& path) { play_dispatch_script(bytes_of_file(path)); }}};
}

}  // namespace genio::test
