#include "server/log/log_event.hpp"

#include <array>

namespace genio {

const char* name_of(LogKind kind) {
  constexpr std::array names = {"serving", "stopped", "resumed",         "answered",
                                "refused", "dropped", "worker_replaced", "journal_failed",
                                "counts",  "left_out"};
  static_assert(names.size() == size_t(LogKind::count));
  return names[size_t(kind)];
}

const char* name_of(LogLevel level) {
  constexpr std::array names = {"info", "warning", "error"};
  return names[size_t(level)];
}

}  // namespace genio
