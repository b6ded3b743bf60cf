#include "server/workers/worker_side.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <new>

#include "forward/base/process_memory.hpp"
#include "server/wire/body.hpp"

namespace genio {
namespace {

constexpr double sign_of_life_s = 0.2;
constexpr int leisure_ms = 1000;

[[noreturn]] void no_memory() { _exit(exit_without_memory); }

}  // namespace

void WorkerPipe::send(const WorkerMessage& message) {
  const auto bytes = packed(message);
  for (size_t sent = 0; sent < bytes.size();) {
    const auto n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(0);
    sent += size_t(n);
  }
  quiet_ = {};
}

void WorkerPipe::receive(int flags) {
  uint8_t room[1 << 16];
  for (;;) {
    const auto n = recv(socket_, room, sizeof room, flags);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) return;
    if (n <= 0) _exit(0);
    return assembler_.add(room, size_t(n));
  }
}

Assignment WorkerPipe::wait() {
  for (;; receive(0)) {
    const auto message = assembler_.next();
    if (!message) continue;
    // A withdrawal may come after the answer has left.
    if (message->word != WorkerWord::compute) continue;
    withdrawn_ = false;
    BodyReader body(message->body);
    Assignment a;
    a.model = size_t(body.integer()), a.deadline_s = body.number();
    a.request = body.block(), a.start = body.block();
    return a;
  }
}

bool WorkerPipe::called(int within_ms) const {
  pollfd polled{socket_, POLLIN, 0};
  return poll(&polled, 1, within_ms) != 0;
}

bool WorkerPipe::withdrawn() {
  receive(MSG_DONTWAIT);
  while (const auto message = assembler_.next())
    withdrawn_ |= message->word == WorkerWord::withdraw;
  if (quiet_.seconds() > sign_of_life_s) send({WorkerWord::alive, {}});
  return withdrawn_;
}

void WorkerPipe::tell_progress(int iteration, double rms_mm) {
  send({WorkerWord::progress, BodyWriter().add(int64_t(iteration)).add(rms_mm).take()});
}

void WorkerPipe::tell_improved(const command_reply_t& so_far) {
  send({WorkerWord::improved, encode(so_far)});
}

void WorkerPipe::tell_answer(const command_reply_t& reply, const std::vector<uint8_t>& state) {
  send({WorkerWord::answer, BodyWriter().add(encode(reply)).add(state).take()});
}

void limit_memory(double mb) {
  std::set_new_handler(no_memory);
  limit_addresses(size_t(1e6 * mb));
}

void run_worker(int socket, const std::function<void(const Assignment&, WorkerPipe&)>& answer,
                const std::function<void(const WorkerPipe&)>& idle) {
  WorkerPipe pipe(socket);
  bool prepares = true;
  const auto prepare = [&] {
    // What cannot be prepared is met again, and answered for, when a request needs it.
    try {
      if (prepares) idle(pipe);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception&) {
      prepares = false;
    }
  };
  try {
    for (;;) {
      if (idle && !pipe.called(leisure_ms)) prepare();
      answer(pipe.wait(), pipe);
    }
  } catch (const std::bad_alloc&) {
    no_memory();
  }
}

}  // namespace genio
