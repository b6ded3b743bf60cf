#include "inverse/recording/binary/own_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <new>

#include "forward/base/process_memory.hpp"
#include "forward/base/types.hpp"

namespace genio {
namespace {

constexpr rlim_t most_seconds = 30;
constexpr size_t most_bytes = size_t(2) << 30;  // beyond what is in use, and of an answer
// An answer is one of these and the text; `end_mark` is written last.
constexpr char result_mark = 'R', refusal_mark = 'I', end_mark = '.';

void limit(__rlimit_resource_t what, rlim_t value) {
  const rlimit both{value, value};
  setrlimit(what, &both);
}

void write_all_to(int pipe, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t n = write(pipe, text.data() + done, text.size() - done);
    if (n < 0 && errno != EINTR) _exit(1);
    if (n > 0) done += size_t(n);
  }
}

[[noreturn]] void be_child(int pipe, const std::string& path,
                           const std::function<std::string()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int s : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGTERM, SIGINT})
    signal(s, SIG_DFL);
  limit(RLIMIT_CORE, 0), limit(RLIMIT_CPU, most_seconds);
  limit_addresses(most_bytes);
  if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) dup2(nowhere, 2);
  std::string answer;
  try {
    answer = result_mark + work();
  } catch (const InputError& e) {
    answer = refusal_mark + std::string(e.what());
  } catch (const std::bad_alloc&) {
    answer = refusal_mark + path + ": asks for more memory than any recording needs; is it broken?";
  } catch (const std::exception& e) {
    answer = refusal_mark + path + ": cannot be read: " + e.what();
  }
  write_all_to(pipe, answer);
  write_all_to(pipe, std::string(1, end_mark));
  _exit(0);
}

std::string read_all_of(int pipe) {
  std::string answer;
  char buffer[65536];
  for (;;) {
    const ssize_t n = read(pipe, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0 || answer.size() > most_bytes) return answer;
    answer.append(buffer, size_t(n));
  }
}

}  // namespace

std::string in_own_process(const std::string& path, const std::function<std::string()>& work) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw InputError(path + ": no pipe to the process that reads it");
  const pid_t process = fork();
  if (process < 0) throw InputError(path + ": no process can be started to read it");
  if (process == 0) be_child(ends[1], path, work);
  close(ends[1]);
  std::string answer = read_all_of(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (answer.size() >= 2 && answer.back() == end_mark) {
    answer.pop_back();
    const char kind = answer.front();
    answer.erase(0, 1);
    if (kind == result_mark) return answer;
    throw InputError(answer);
  }
  const bool late =
      WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  throw InputError(path + (late ? ": takes too long to read; is it broken?"
                                : ": is broken: the library that reads such files crashed on it"));
}

}  // namespace genio
