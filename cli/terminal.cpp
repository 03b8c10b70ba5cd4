#include "cli/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>

namespace dwell::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;
bool line_open = false;

extern "C" void on_signal(int) { interrupted = 1; }

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

void finish_progress() {
  if (line_open) fmt::print(stderr, "\r\x1b[K");
  line_open = false;
}

Progress terminal_progress() {
  using Clock = std::chrono::steady_clock;
  Progress progress;
  const bool in_place = isatty(STDERR_FILENO) != 0;
  progress.show = [in_place, next = Clock::now() + std::chrono::seconds(1)](const std::string& line) mutable {
    const auto now = Clock::now();
    if (now < next) return;
    next = now + std::chrono::seconds(1);
    if (in_place) {
      fmt::print(stderr, "\r\x1b[K{}", line);
      line_open = true;
    } else {
      fmt::print(stderr, "{}\n", line);
    }
    std::fflush(stderr);
  };
  progress.stop = [] { return interrupted != 0; };
  return progress;
}

int say_limits(const std::vector<std::string>& limits) {
  for (const std::string& limit : limits) fmt::print(stderr, "dwell: limit reached: {}\n", limit);
  return limits.empty() ? kDone : kLimitReached;
}

}  // namespace dwell::cli
