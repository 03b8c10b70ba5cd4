#include "bench/child.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace dwell::bench {

ChildEnd run_child(const std::vector<std::string>& arguments, int threads, double max_seconds) {
  const std::string count = std::to_string(threads);
  std::vector<std::string> words{"dwell-bench"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  setenv("OMP_NUM_THREADS", count.c_str(), 1);

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    execv("/proc/self/exe", argv.data());
    _exit(127);
  }
  const auto begin = std::chrono::steady_clock::now();
  bool killed = false;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (killed || std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < max_seconds)
      continue;
    kill(child, SIGKILL);
    killed = true;
  }
  if (killed) return ChildEnd::Killed;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? ChildEnd::Done : ChildEnd::Failed;
}

}  // namespace dwell::bench
