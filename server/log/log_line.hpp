#pragma once
#include "server/log/log_event.hpp"

namespace genio {

enum class LogForm { text, json };

inline constexpr size_t longest_logged = 200;  ///< bytes of a string; of more, the beginning

/// An event as one line, with its end, of printable signs alone. `utime` [us since 1970]. As text:
/// time, level, event, then `name=value`, where a value with spaces stands in double quotes and
/// other bytes as in escaped_text(). As JSON: one object of `time`, `level`, `event` and the
/// fields, in ASCII; what is no number is null.
std::string log_line(const LogEvent& event, int64_t utime, LogForm form);

}  // namespace genio
