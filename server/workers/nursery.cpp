#include "server/workers/nursery.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>

namespace genio {
namespace {

struct NurseryOrder {
  char what;  // 'b': bear, 'k': kill
  pid_t pid;
};
/// A NurseryEvent as it travels; the socket goes beside it.
struct NurseryNews {
  NurseryEvent::Kind kind;
  pid_t pid;
  int status;
};

/// Sends news, with a descriptor where there is one. False where nobody hears.
bool tell(int socket, const NurseryNews& news, int descriptor = -1) {
  iovec data{const_cast<NurseryNews*>(&news), sizeof news};
  alignas(cmsghdr) char room[CMSG_SPACE(sizeof descriptor)] = {};
  msghdr message{};
  message.msg_iov = &data, message.msg_iovlen = 1;
  if (descriptor >= 0) {
    message.msg_control = room, message.msg_controllen = sizeof room;
    cmsghdr* head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET, head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof descriptor);
    std::memcpy(CMSG_DATA(head), &descriptor, sizeof descriptor);
  }
  return sendmsg(socket, &message, MSG_NOSIGNAL) == ssize_t(sizeof news);
}

/// The life of the forked process.
class NurseryLife {
 public:
  NurseryLife(int socket, const std::function<void(int)>& work) : socket_(socket), work_(work) {}

  [[noreturn]] void live() {
    // Whoever stops the service by a signal to its group stops that process alone, in good order.
    signal(SIGINT, SIG_IGN), signal(SIGTERM, SIG_IGN);
    sigset_t child;
    sigemptyset(&child), sigaddset(&child, SIGCHLD);
    sigprocmask(SIG_BLOCK, &child, nullptr);
    const int ended = signalfd(-1, &child, SFD_NONBLOCK | SFD_CLOEXEC);
    for (;;) {
      pollfd polled[2] = {{socket_, POLLIN, 0}, {ended, POLLIN, 0}};
      if (poll(polled, 2, -1) < 0 && errno != EINTR) leave();
      signalfd_siginfo info;
      while (read(ended, &info, sizeof info) == sizeof info) {
      }
      reap();
      if (polled[0].revents != 0) obey();
    }
  }

 private:
  [[noreturn]] void leave() const {
    for (pid_t worker : workers_) ::kill(worker, SIGKILL);
    _exit(0);
  }
  void reap() {
    int status = 0;
    for (pid_t pid; (pid = waitpid(-1, &status, WNOHANG)) > 0;) {
      workers_.erase(pid);
      if (!tell(socket_, {NurseryEvent::Kind::ended, pid, status})) leave();
    }
  }
  void obey() {
    NurseryOrder order{};
    const auto n = recv(socket_, &order, sizeof order, MSG_DONTWAIT);
    if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (n != ssize_t(sizeof order)) leave();  // the service has ended
    if (order.what == 'k' && workers_.contains(order.pid)) ::kill(order.pid, SIGKILL);
    if (order.what == 'b') bear_one();
  }
  void bear_one() {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0) return refuse(errno);
    const pid_t pid = fork();
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      close(pair[0]), close(socket_);
      sigset_t none;
      sigemptyset(&none), sigprocmask(SIG_SETMASK, &none, nullptr);
      work_(pair[1]);
      _exit(0);
    }
    const int error = errno;
    close(pair[1]);
    if (pid < 0) refuse(error);
    else if (workers_.insert(pid); !tell(socket_, {NurseryEvent::Kind::born, pid, 0}, pair[0]))
      leave();
    close(pair[0]);
  }
  void refuse(int error) const {
    if (!tell(socket_, {NurseryEvent::Kind::not_born, 0, error})) leave();
  }

  int socket_;
  const std::function<void(int)>& work_;
  std::set<pid_t> workers_;
};

}  // namespace

Nursery::Nursery(const std::function<void(int)>& work) {
  int pair[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair) != 0)
    throw std::runtime_error(std::string("cannot make a socket for workers: ") + strerror(errno));
  pid_ = fork();
  if (pid_ == 0) {
    // Ports and files of this process are not held open beyond its life.
    close_range(3, unsigned(pair[1]) - 1, 0), close_range(unsigned(pair[1]) + 1, ~0u, 0);
    NurseryLife(pair[1], work).live();
  }
  close(pair[1]);
  socket_ = pair[0];
  if (pid_ > 0) return;
  close(socket_);
  throw std::runtime_error(std::string("cannot make a process for workers: ") + strerror(errno));
}

Nursery::~Nursery() {
  close(socket_);
  waitpid(pid_, nullptr, 0);
}

void Nursery::bear() const {
  const NurseryOrder order{'b', 0};
  send(socket_, &order, sizeof order, MSG_NOSIGNAL);
}

void Nursery::kill(pid_t worker) const {
  const NurseryOrder order{'k', worker};
  send(socket_, &order, sizeof order, MSG_NOSIGNAL);
}

std::vector<NurseryEvent> Nursery::events() const {
  std::vector<NurseryEvent> events;
  for (;;) {
    NurseryNews news{};
    iovec data{&news, sizeof news};
    alignas(cmsghdr) char room[CMSG_SPACE(sizeof(int))] = {};
    msghdr message{};
    message.msg_iov = &data, message.msg_iovlen = 1;
    message.msg_control = room, message.msg_controllen = sizeof room;
    const auto n = recvmsg(socket_, &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) return events;
    if (n != ssize_t(sizeof news))
      throw std::runtime_error("the process that makes workers has ended; start the service again");
    NurseryEvent event{news.kind, news.pid, -1, news.status};
    if (const cmsghdr* head = CMSG_FIRSTHDR(&message); head && head->cmsg_type == SCM_RIGHTS)
      std::memcpy(&event.socket, CMSG_DATA(head), sizeof event.socket);
    events.push_back(event);
  }
}

}  // namespace genio
