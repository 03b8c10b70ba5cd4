#include "cli/terminal.h"

#include <fmt/format.h>
#include <semaphore.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <mutex>
#include <new>
#include <stdexcept>
#include <thread>

#include "cli/progress_line.h"
#include "cli/standard_streams.h"
#include "core/base/errors.h"
#include "core/base/unfinished_output.h"

namespace dwell::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;
sem_t interrupt_asked;
std::mutex saying;
bool interrupt_said = false;

extern "C" void on_signal(int) {
  interrupted = 1;
  sem_post(&interrupt_asked);
}

/// Waits for an interrupt, and ends the process when it was not answered in time: a transform of a large map, or the
/// setting up of its coarse models, does not ask for seconds, and no user waits that long. Nothing is left of what was
/// being written.
void end_if_unanswered() {
  constexpr auto kPatience = std::chrono::milliseconds(100);  // a process of 8 GB takes most of a second to go
  while (sem_wait(&interrupt_asked) != 0) continue;
  std::this_thread::sleep_for(kPatience);
  if (!give_up_outputs()) {
    // The results are in place and the command ends by itself, unless it hangs: the next signal ends it at once.
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    return;
  }
  try {
    say_interrupted();
  } catch (const std::bad_alloc&) {
    _exit(kInterrupted);  // without words
  }
  _exit(kInterrupted);
}

sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, signal);
  return set;
}

}  // namespace

void hold_interrupts() {
  const sigset_t set = interrupts();
  sigprocmask(SIG_BLOCK, &set, nullptr);
}

void catch_interrupts() {
  if (sem_init(&interrupt_asked, 0, 0) != 0) throw std::runtime_error("no semaphore for interrupts");
  std::thread(end_if_unanswered).detach();
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // as nohup asks for
  // A reader that goes away (a closed terminal, `| head`) ends nothing: what is unfinished would stay behind.
  std::signal(SIGPIPE, SIG_IGN);
  // A limit of the file size is a failed write, with its reason, like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  const sigset_t set = interrupts();
  sigprocmask(SIG_UNBLOCK, &set, nullptr);  // what came meanwhile is answered here
}

void ignore_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
}

void say_interrupted() {
  const std::scoped_lock lock(saying);  // whoever comes second may end the process, so waits for the words
  if (interrupt_said) return;
  interrupt_said = true;
  say(fmt::format("{}dwell: {}\n", progress_line_is_open() ? "\r\x1b[K" : "", Interrupted().what()), 100);
}

Progress terminal_progress() {
  Progress progress;
  progress.show = [line = progress_line()](const std::string& news) { line->show(news); };
  progress.stop = [] { return interrupted != 0; };
  return progress;
}

int say_limits(const std::vector<std::string>& limits) {
  for (const std::string& limit : limits) say(fmt::format("dwell: limit reached: {}\n", limit));
  return limits.empty() ? kDone : kLimitReached;
}

}  // namespace dwell::cli
