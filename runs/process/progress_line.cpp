#include "runs/process/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace genio {
namespace {

std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

ProgressLine::ProgressLine(int done, int total, std::string items)
    : items_(std::move(items)),
      first_(done),
      done_(done),
      total_(total),
      terminal_(isatty(STDERR_FILENO)) {}

void ProgressLine::step() {
  ++done_;
  const bool tenth = 10 * done_ / total_ != 10 * (done_ - 1) / total_;
  if (total_ < 2 || (!terminal_ && !tenth)) return;
  constexpr int width = 24;
  const int full = width * done_ / total_;
  const double each = watch_.seconds() / (done_ - first_);
  fmt::print(stderr, "{}[{:#<{}}{:.<{}}] {} of {} {}, {:.2f} s each, {} left{}",
             terminal_ ? "\r" : "", "", full, "", width - full, done_, total_, items_, each,
             duration(each * (total_ - done_)), terminal_ && done_ < total_ ? "  " : "\n");
  std::fflush(stderr);
}

void print_progress(double part, const std::string& what) {
  const bool terminal = isatty(STDERR_FILENO);
  fmt::print(stderr, "{}{:3.0f} % {}{}", terminal ? "\r" : "", 100 * part, what,
             terminal && part < 1 ? "          " : "\n");
  std::fflush(stderr);
}

LongWork::LongWork(std::string what) : what_(std::move(what)) {}

void LongWork::operator()(double part) {
  constexpr double patience_s = 2;
  const int tenth = int(10 * part);
  if (tenth == tenth_ || watch_.seconds() < patience_s) return;
  tenth_ = tenth;
  print_progress(part, what_);
}

}  // namespace genio
