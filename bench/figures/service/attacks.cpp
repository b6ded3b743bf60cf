#include "bench/figures/service/attacks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>

#include "server/hub/protocol/tcpq.hpp"
#include "server/wire/wire.hpp"

namespace genio::bench {
namespace {

std::string message(const std::string& channel, const std::string& payload) {
  const std::vector<char> bytes = tcpq::publication(channel, payload);
  return {bytes.begin(), bytes.end()};
}

template <class T>
std::string encoded(const T& value) {
  const std::vector<uint8_t> bytes = encode(value);
  return {bytes.begin(), bytes.end()};
}

/// Ten thousand small messages are too many for one call, so many go together.
std::string repeated(const std::string& one, size_t bytes) {
  std::string all;
  while (all.size() < bytes) all += one;
  return all;
}

std::string random_bytes(uint64_t seed, size_t count) {
  std::mt19937_64 random(seed);
  std::string bytes(count, 0);
  std::generate(bytes.begin(), bytes.end(), [&] { return char(random()); });
  return bytes;
}

shape_request_t named(shape_request_t r, uint64_t number) {
  r.id = fmt::format("attack-{}", number), r.client = fmt::format("attacker-{}", number % 20);
  return r;
}

std::string pattern_bytes(uint64_t number) {
  constexpr std::array backtracking{"(a*)*b", "(a|aa)+b", "((a+)+)+b", "(.*)*(.*)*b"};
  const std::string pattern = number % 2 == 0
                                  ? std::string(backtracking[number / 2 % 4])
                                  : fmt::format("({}{})*", number, std::string(230, 'a'));
  const std::vector<char> bytes = tcpq::subscription(pattern);
  return std::string(bytes.begin(), bytes.end()) + message(std::string(200, 'a'), "x");
}

Attack flood(const std::string& name, const std::string& one, size_t together = 1 << 16) {
  return {.name = name, .reads = true, .bytes = [all = repeated(one, together)](uint64_t) {
            return all;
          }};
}

std::vector<Attack> hub_attacks() {
  const auto nothing = [](uint64_t) { return std::string(); };
  return {
      {.name = "idle", .connections = 400, .bytes = nothing},
      {.name = "half open", .connections = 400, .greets = false, .bytes = nothing},
      {.name = "reconnects",
       .connections = 200,
       .leaves = true,
       .bytes = [](uint64_t) { return message("A", "x"); }},
      {.name = "patterns", .bytes = pattern_bytes},
      {.name = "slow readers",
       .subscribes = true,
       .bytes =
           [](uint64_t n) {
             return n % 20 == 0 ? message("A", std::string(4u << 20, 'x')) : std::string();
           }},
      {.name = "noise", .greets = false, .bytes = [](uint64_t n) { return random_bytes(n, 4096); }},
      flood("large messages", message("A", std::string(1 << 16, 'x'))),
      flood("tiny messages", message("A", ""))};
}

std::vector<Attack> service_attacks(const shape_request_t& question) {
  shape_request_t long_kind = named(question, 0);
  for (std::string& kind : long_kind.kind) kind = std::string(4000000 / long_kind.kind.size(), 'k');
  shape_request_t many_points = named(question, 1);
  const int count = 100000;
  many_points.point_count = count;
  for (auto* values :
       {&many_points.x_mm, &many_points.y_mm, &many_points.z_mm, &many_points.sigma_mm})
    values->assign(count, 1);
  many_points.kind.assign(count, "tip");
  shape_request_t long_request = named(question, 4);
  long_request.prior = std::string(42000, '#');
  const std::string same = encoded(named(question, 2));
  return {
      flood("long kinds", message("GENIO_REQUEST", encoded(long_kind)), 1),
      flood("many points", message("GENIO_REQUEST", encoded(many_points)), 1),
      flood("the same request", message("GENIO_REQUEST", same)),
      {.name = "requests",
       .reads = true,
       .bytes = [question](
                    uint64_t n) { return message("GENIO_REQUEST", encoded(named(question, n))); }},
      {.name = "reconnects with requests",
       .connections = 40,
       .leaves = true,
       .bytes = [refused = encoded(long_request)](
                    uint64_t) { return message("GENIO_REQUEST", refused); }},
      {.name = "one id, other contents",
       .reads = true,
       .bytes =
           [question](uint64_t n) {
             shape_request_t r = named(question, 3);
             r.x_mm.front() += 1e-3 * double(n);
             return message("GENIO_REQUEST", encoded(r));
           }},
      {.name = "spoiled requests",
       .reads = true,
       .bytes =
           [same](uint64_t n) {
             std::string spoiled = same;
             spoiled[n % spoiled.size()] ^= char(1 + n % 255);
             return message("GENIO_REQUEST", spoiled);
           }},
      flood("cancels", message("GENIO_CANCEL", encoded(cancel_t{0, "attack-4", "attacker"}))),
      flood("acknowledgements", message("GENIO_ACK", encoded(ack_t{0, "attack-4", "attacker"}))),
      flood("asks for the status", message("GENIO_ASK_STATUS", std::string(1, 0)))};
}

}  // namespace

std::vector<Attack> all_attacks(const shape_request_t& question) {
  std::vector<Attack> all = hub_attacks();
  for (Attack& a : service_attacks(question)) all.push_back(std::move(a));
  return all;
}

}  // namespace genio::bench
