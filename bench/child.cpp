#include "bench/child.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>

namespace dwell::bench {

ChildEnd run_child(const std::vector<std::string>& arguments, int threads) {
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
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::runtime_error("lost a process");
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return ChildEnd::Killed;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? ChildEnd::Done : ChildEnd::Failed;
}

}  // namespace dwell::bench
