#pragma once
#include <string_view>

#include "server/hub/descriptor.hpp"

namespace genio {

/// Writes whole lines to a descriptor and survives what may go wrong there.
class LogOutput {
 public:
  /// Keeps a copy of the descriptor, so that nobody else's use of it changes where lines go.
  explicit LogOutput(int descriptor);

  /// Waits as long as the other side lets it wait. False where the line could not be written; what
  /// was written of it is then ended before the next one.
  bool write(std::string_view line);

 private:
  bool write_bytes(std::string_view bytes);

  Descriptor out_;
  bool within_a_line_ = false;
};

}  // namespace genio
