#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace dwell::test {

struct ProgramResult {
  int exit_code = -1;  // 128 + signal if a signal ended it
  std::string out, err;
};

/// The built program, run as a user runs it: its own process, standard output and error kept apart.
class ProgramRun {
 public:
  /// Starts the program in `folder`; its output goes to files of a folder beside it that is removed at the end.
  ProgramRun(const std::filesystem::path& folder, const std::vector<std::string>& arguments)
      : capture_(folder.string() + "-capture") {
    std::filesystem::create_directories(capture_);
    std::vector<std::string> words{DWELL_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = (capture_ / "out").string(), err = (capture_ / "err").string();
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ > 0) return;
    const int o = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int e = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (o < 0 || e < 0 || dup2(o, 1) < 0 || dup2(e, 2) < 0 || chdir(folder.c_str()) != 0) _exit(125);
    execv(argv[0], argv.data());
    _exit(126);
  }
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;
  ~ProgramRun() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    std::error_code ignored;
    std::filesystem::remove_all(capture_, ignored);
  }

  void interrupt() const { signal(SIGINT); }
  void signal(int number) const {
    if (pid_ > 0) kill(pid_, number);  // 0 would be the whole process group
  }
  /// What has been written to standard error so far.
  std::string err() const { return text_of("err"); }
  /// Whether it has ended; its result is kept for wait().
  bool ended() {
    if (pid_ > 0 && waitpid(pid_, &status_, WNOHANG) == pid_) pid_ = 0;
    return pid_ == 0;
  }

  ProgramResult wait() {
    while (pid_ > 0 && waitpid(pid_, &status_, 0) < 0 && errno == EINTR) continue;
    pid_ = 0;
    const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
    return {code, text_of("out"), text_of("err")};
  }

 private:
  std::string text_of(const char* name) const {
    std::ostringstream text;
    text << std::ifstream(capture_ / name, std::ios::binary).rdbuf();
    return text.str();
  }

  std::filesystem::path capture_;
  pid_t pid_ = 0;
  int status_ = 0;
};

inline ProgramResult run_program(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  return ProgramRun(folder, arguments).wait();
}

inline void expect_has(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in: " << text;
}

}  // namespace dwell::test
