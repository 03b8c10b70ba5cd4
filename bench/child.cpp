#include "bench/child.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "core/base/errors.h"
#include "core/base/whole_file.h"

namespace dwell::bench {
namespace {

/// The first of those on which this process may run; outlives execv.
bool stay_on_one_processor() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return false;
  int first = 0;
  while (first < CPU_SETSIZE && !CPU_ISSET(first, &allowed)) ++first;
  CPU_ZERO(&allowed);
  CPU_SET(first, &allowed);
  return sched_setaffinity(0, sizeof allowed, &allowed) == 0;
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

volatile std::sig_atomic_t interrupt_asked = 0;

void note_interrupt(int) { interrupt_asked = 1; }

/// Waits until a process has ended, or ends it if this one is interrupted.
int wait_for(pid_t child, rusage& usage) {
  int status = 0;
  bool told = false;
  while (wait4(child, &status, 0, &usage) < 0) {
    if (errno != EINTR) throw std::runtime_error("lost a process");
    if (interrupt_asked && !told) {
      told = true;
      kill(child, SIGTERM);
    }
  }
  if (interrupt_asked) throw Interrupted();
  return status;
}

/// Sends SIGINT to a process after so many seconds, unless it ends before. Returns when; begin if it did not.
std::chrono::steady_clock::time_point interrupt_in_time(pid_t child, std::chrono::steady_clock::time_point begin,
                                                        double seconds) {
  constexpr auto kLook = std::chrono::milliseconds(5);
  const auto when = begin + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < when) {
    siginfo_t info{};
    if (waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child)
      return begin;
    std::this_thread::sleep_for(kLook);
  }
  kill(child, SIGINT);
  return std::chrono::steady_clock::now();
}

[[noreturn]] void become(const std::filesystem::path& program, char* const* argv, const ChildOptions& options) {
  if (!options.output.empty()) {
    const int file = open(options.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || dup2(file, STDOUT_FILENO) < 0 || dup2(file, STDERR_FILENO) < 0) _exit(126);
  }
  if (options.one_processor && !stay_on_one_processor()) _exit(126);
  // Nobody would end it if this process were killed. Outlives execv, as does an alarm.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (!options.scratch.empty()) setenv("TMPDIR", options.scratch.c_str(), 1);
  if (options.limit > 0.0) alarm(static_cast<unsigned>(std::ceil(options.limit)));
  execv(program.c_str(), argv);
  _exit(127);
}

}  // namespace

void end_children_on_interrupt() {
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESETHAND;  // and none that restarts wait4
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

ChildRun run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                     const ChildOptions& options) {
  std::vector<std::string> words{program.filename().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  setenv("OMP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);
  // As `dwell` sets it for itself: threads that spin while they wait would count as CPU seconds of work.
  setenv("OMP_WAIT_POLICY", "passive", 1);

  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) become(program, argv.data(), options);
  const auto interrupted =
      options.interrupt_after > 0.0 ? interrupt_in_time(child, begin, options.interrupt_after) : begin;
  rusage usage{};
  const int status = wait_for(child, usage);
  ChildRun run;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (interrupted != begin) {
    run.interrupted_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - interrupted).count();
  }
  run.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  run.peak_memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  if (run.exit_code == 0) run.end = ChildEnd::Done;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) run.end = ChildEnd::Killed;
  return run;
}

std::string last_line_of(const std::filesystem::path& file) {
  std::string text = std::filesystem::exists(file) ? read_whole_file(file) : "";
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

ChildRun run_child(const std::vector<std::string>& arguments, const ChildOptions& options) {
  return run_program("/proc/self/exe", arguments, options);
}

}  // namespace dwell::bench
