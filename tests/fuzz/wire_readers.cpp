// Messages from the network.

#include <fstream>
#include <iterator>

#include "forward/base/types.hpp"
#include "server/wire/wire.hpp"
#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {
namespace {

template <class T>
std::string bytes_of(const T& message) {
  const auto bytes = encode(message);
  return {bytes.begin(), bytes.end()};
}

std::string sample_request() {
  shape_request_t r{};
  r.id = "a", r.client = "c", r.point_count = 2;
  r.x_mm = {1, 2}, r.y_mm = {0, 0}, r.z_mm = {3, 4}, r.sigma_mm = {0, 0}, r.kind = {"curve", "tip"};
  return bytes_of(r);
}

std::string sample_sealed() {
  sealed_t s{};
  s.channel = "GENIO_ACK", s.body = encode(ack_t{}), s.size = int(s.body.size());
  return bytes_of(s);
}

template <class T>
bool decodes(const std::string& bytes, std::string& why) {
  return decode_checked<T>(bytes.data(), bytes.size(), why).has_value();
}

void read_message(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  std::string why;
  if (!decodes<shape_request_t>(bytes, why) && !decodes<command_reply_t>(bytes, why) &&
      !decodes<progress_t>(bytes, why) && !decodes<cancel_t>(bytes, why) &&
      !decodes<server_status_t>(bytes, why) && !decodes<sealed_t>(bytes, why))
    throw InputError(why);
}

}  // namespace

std::vector<FuzzReader> wire_readers() {
  return {{"wire",
           "message",
           {sample_request(), bytes_of(command_reply_t{}), bytes_of(progress_t{}),
            bytes_of(cancel_t{}), bytes_of(server_status_t{}), sample_sealed()},
           read_message}};
}

}  // namespace genio::test
