// A log whose other side does what it likes.

#include "server/log/log.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <array>
#include <csignal>
#include <sstream>

#include "forward/base/elapsed.hpp"
#include "server/log/log_output.hpp"

namespace genio {
namespace {

using std::chrono::milliseconds;

constexpr double soon = 20;  // [s]; the machine may be busy

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    reader.reset(ends[0]), writer.reset(ends[1]);
  }
  /// All that comes until nobody can write any more, or nothing came for so long.
  std::string read_all(int patience_ms) const {
    std::string all;
    std::array<char, 4096> bytes;
    pollfd polled{reader.get(), POLLIN, 0};
    while (poll(&polled, 1, patience_ms) > 0) {
      const ssize_t got = ::read(reader.get(), bytes.data(), bytes.size());
      if (got <= 0) break;
      all.append(bytes.data(), size_t(got));
    }
    return all;
  }
  Descriptor reader, writer;
};

LogEvent answer_number(int k) {
  return {LogKind::answered, LogLevel::info, {{"id", std::to_string(k)}}};
}

int count_of(const std::string& part, const std::string& text) {
  int count = 0;
  for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Lines of answers, and those that other lines say were left out.
int told_of(const std::string& text) {
  int told = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    told += line.find(" answered id=") != line.npos;
    if (const size_t at = line.find(" lines="); at != line.npos)
      told += std::stoi(line.substr(at + 7));
  }
  return told;
}

TEST(Log, LinesArriveWholeAndInOrder) {
  Pipe pipe;
  {
    Log log(LogForm::text, pipe.writer.get(), {.a_second = 1000});
    for (int k = 0; k < 500; ++k) log.write(answer_number(k));
  }
  pipe.writer.reset();
  std::istringstream lines(pipe.read_all(1000));
  std::string line;
  for (int k = 0; k < 500; ++k) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_TRUE(line.ends_with(" info answered id=" + std::to_string(k))) << line;
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(Log, ALineSaysHowManyOfAKindWereTooMany) {
  Pipe pipe;
  {
    Log log(LogForm::text, pipe.writer.get(), {.a_second = 10});
    for (int k = 0; k < 500; ++k) log.write(answer_number(k));
    log.write({LogKind::stopped});
  }
  pipe.writer.reset();
  const std::string text = pipe.read_all(1000);
  EXPECT_GE(count_of(" answered id=", text), 10);
  EXPECT_LT(count_of(" answered id=", text), 500);
  EXPECT_EQ(told_of(text), 500) << text;
  EXPECT_EQ(count_of(" stopped", text), 1);
}

TEST(Log, WhatWasTooManyIsToldWithoutAFurtherEvent) {
  Pipe pipe;
  Log log(LogForm::text, pipe.writer.get(), {.a_second = 1});
  log.write(answer_number(0));
  log.write(answer_number(1));
  std::string text;
  for (const Stopwatch watch; watch.seconds() < soon && text.find("lines=1") == text.npos;)
    text += pipe.read_all(100);
  EXPECT_EQ(count_of("left_out kind=answered lines=1 ", text), 1) << text;
}

TEST(Log, AReaderThatReadsNothingHoldsNobodyUp) {
  Pipe pipe;
  std::string text;
  {
    Log log(LogForm::text, pipe.writer.get(),
            {.a_second = 1000000, .waiting = 200, .last = milliseconds(10)});
    const Stopwatch watch;
    for (int k = 0; k < 20000; ++k) log.write(answer_number(k));  // 1.2 MB; a pipe holds 64 kB
    EXPECT_LT(watch.seconds(), soon);
    // Once it is read, the lines that did not fit are counted.
    for (const Stopwatch again; again.seconds() < soon && told_of(text) < 20000;)
      text += pipe.read_all(100);
  }
  EXPECT_EQ(told_of(text), 20000);
  EXPECT_GT(count_of("they were not read in time", text), 0);
}

TEST(Log, TheEndWaitsForNoReaderForEver) {
  Pipe pipe;
  const Stopwatch watch;
  {
    Log log(LogForm::text, pipe.writer.get(), {.a_second = 1000000, .last = milliseconds(100)});
    for (int k = 0; k < 2000; ++k) log.write(answer_number(k));
  }
  EXPECT_LT(watch.seconds(), soon);
  pipe.read_all(100);  // lets the thread end
}

TEST(Log, AReaderThatIsGoneEndsNothing) {
  Pipe pipe;
  Log log(LogForm::text, pipe.writer.get());
  pipe.reader.reset();
  for (int k = 0; k < 20; ++k) log.write(answer_number(k));  // no SIGPIPE
}

TEST(Log, AFullDiskOrAClosedDescriptorEndsNothing) {
  const Descriptor full(open("/dev/full", O_WRONLY | O_CLOEXEC));
  ASSERT_TRUE(full);
  for (const int descriptor : {full.get(), -1}) {
    Log log(LogForm::json, descriptor);
    for (int k = 0; k < 20; ++k) log.write(answer_number(k));
  }
}

TEST(Log, TheDescriptorMayBecomeAnotherFile) {
  Pipe mine, other;
  {
    Log log(LogForm::text, mine.writer.get());
    dup2(other.writer.get(), mine.writer.get());
    log.write(answer_number(1));
  }
  mine.writer.reset(), other.writer.reset();
  EXPECT_EQ(count_of("answered", mine.read_all(1000)), 1);
  EXPECT_EQ(other.read_all(0), "");
}

TEST(Log, AForkedChildTellsNothingAndEnds) {
  Pipe pipe;
  auto log = std::make_unique<Log>(LogForm::text, pipe.writer.get());
  const pid_t child = fork();
  if (child == 0) {
    alarm(unsigned(soon));
    log->write(answer_number(1));
    log.reset();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  log->write(answer_number(2));
  log.reset(), pipe.writer.reset();
  const std::string text = pipe.read_all(1000);
  EXPECT_EQ(count_of("id=1", text), 0);
  EXPECT_EQ(count_of("id=2", text), 1);
}

/// While it lives, files of the process end at so many bytes.
class ShortFiles {
 public:
  explicit ShortFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit lower = before_;
    lower.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &lower);
  }
  ~ShortFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  ShortFiles(const ShortFiles&) = delete;
  ShortFiles& operator=(const ShortFiles&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(LogOutput, ALineThatWasCutOffIsEndedBeforeTheNext) {
  std::string path = testing::TempDir() + "genio_log_XXXXXX";
  const Descriptor file(mkstemp(path.data()));
  ASSERT_TRUE(file);
  unlink(path.c_str());
  LogOutput output(file.get());
  EXPECT_TRUE(output.write("first\n"));
  {
    const ShortFiles full(9);
    EXPECT_FALSE(output.write("second\n"));
    EXPECT_FALSE(output.write("third\n"));
  }
  EXPECT_TRUE(output.write("fourth\n"));
  std::array<char, 100> bytes{};
  const ssize_t got = pread(file.get(), bytes.data(), bytes.size(), 0);
  EXPECT_EQ(std::string(bytes.data(), size_t(got)), "first\nsec\nfourth\n");
}

TEST(LogOutput, ADescriptorThatDoesNotWaitIsWaitedFor) {
  Pipe pipe;
  fcntl(pipe.writer.get(), F_SETFL, O_NONBLOCK);
  std::thread writing([&] {
    LogOutput output(pipe.writer.get());
    for (int k = 0; k < 3000; ++k) output.write(std::string(99, 'x') + '\n');
    pipe.writer.reset();
  });
  const std::string all = pipe.read_all(int(1000 * soon));
  writing.join();
  EXPECT_EQ(all.size(), 300000u);
}

}  // namespace
}  // namespace genio
