#include "server/link/silenced.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace genio {
namespace {

std::mutex only_one;

}  // namespace

Silenced::Silenced() : one_(only_one), kept_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0)) {
  std::fflush(stderr);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

Silenced::~Silenced() {
  std::fflush(stderr);
  if (kept_ < 0) return;
  dup2(kept_, STDERR_FILENO);
  close(kept_);
}

}  // namespace genio
