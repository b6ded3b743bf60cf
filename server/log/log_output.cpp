#include "server/log/log_output.hpp"

#include <fcntl.h>
#include <poll.h>

#include <cerrno>

namespace genio {

LogOutput::LogOutput(int descriptor) : out_(fcntl(descriptor, F_DUPFD_CLOEXEC, 0)) {}

bool LogOutput::write(std::string_view line) {
  if (within_a_line_ && !write_bytes("\n")) return false;
  return write_bytes(line);
}

bool LogOutput::write_bytes(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(out_.get(), bytes.data(), bytes.size());
    if (written > 0) {
      within_a_line_ = bytes[size_t(written) - 1] != '\n';
      bytes.remove_prefix(size_t(written));
    } else if (errno == EAGAIN) {  // whoever gave us the descriptor wants it so
      pollfd room{out_.get(), POLLOUT, 0};
      poll(&room, 1, -1);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace genio
