#include "inverse/posterior/estimate.hpp"

namespace genio {

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return "none";
    case Verdict::explained:
      return "explained";
    case Verdict::unreachable:
      return "unreachable";
    case Verdict::mismatch:
      return "mismatch";
  }
  return "none";
}

std::vector<std::string> names(const TradeOff& trade) {
  std::vector<std::string> result;
  for (const Share& share : trade) result.push_back(share.name);
  return result;
}

}  // namespace genio
