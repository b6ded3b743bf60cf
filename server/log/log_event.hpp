#pragma once
// What happened, before it is text.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace genio {

/// docs/operating.md says when each is told and with what.
enum class LogKind {
  serving,          ///< requests are answered from now on
  stopped,          ///< the last word of a server
  resumed,          ///< an earlier process left requests unanswered
  answered,         ///< a request has its reply
  refused,          ///< a request that nothing was computed for
  dropped,          ///< a message that nobody could be told about
  worker_replaced,  ///< a worker crashed, hung or took too much memory
  journal_failed,   ///< the journal could not be written
  counts,           ///< what was counted in the last minute
  left_out,         ///< lines that were too many or could not be written
  count
};
const char* name_of(LogKind kind);

enum class LogLevel { info, warning, error };
const char* name_of(LogLevel level);

struct LogField {
  const char* name;
  std::variant<std::string, int64_t, double> value;
};

struct LogEvent {
  LogKind kind;
  LogLevel level = LogLevel::info;
  std::vector<LogField> fields = {};
};

}  // namespace genio
