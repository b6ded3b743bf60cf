#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "server/link/link.hpp"

namespace genio::test {

/// Two real LCM connections that send each other messages, whatever else happens to the hub.
class HonestClient {
 public:
  explicit HonestClient(uint16_t port, const std::string& channel = "HONEST");
  /// From publishing to receiving [ms]; no_answer when it takes longer than that.
  double one_way_ms();
  /// The times of messages in a row, over `for_ms`.
  std::vector<double> times_for(double for_ms);

  static constexpr double no_answer = 10000;  ///< [ms]

 private:
  std::string channel_;
  Link publisher_, subscriber_;
  int sent_ = 0, received_ = 0;
};

/// What came of it, in the log of the test; the worst [ms].
double worst_of(std::vector<double> times);

}  // namespace genio::test
