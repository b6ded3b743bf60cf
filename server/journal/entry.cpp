#include "server/journal/entry.hpp"

namespace genio {

const char* to_string(JournalState state) {
  switch (state) {
    case JournalState::accepted:
      return "accepted";
    case JournalState::answered:
      return "answered";
    case JournalState::delivered:
      return "delivered";
  }
  return "unknown";
}

}  // namespace genio
