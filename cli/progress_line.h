#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace dwell::cli {

/// The line on standard error that says how far a command is: from the second second on, the latest news at most once a
/// second; in place on a terminal, else line by line. A thread of its own shows news that came too soon after other
/// news, and how long a step has taken that has none, every second on a terminal, else every ten.
class ProgressLine {
 public:
  ProgressLine();
  /// Clears the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// The news. From any thread.
  void show(const std::string& line);
  /// Shows nothing until there is news again, and clears the line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void watch();
  void print_if_due(Clock::time_point now);

  std::mutex mutex_;
  std::condition_variable ended_;
  const bool in_place_;
  std::string line_;  // empty: nothing to show
  bool shown_ = true, open_ = false, end_ = false;
  Clock::time_point since_, last_;  // when the line came; when something was printed last
  std::thread thread_;
};

/// Clears whatever line is shown: before results or errors are printed.
void finish_progress();

/// Whether a line stands on the terminal without an end.
bool progress_line_is_open();

/// What was last shown by any line, also after it has gone: what the program was at when something went wrong.
std::string latest_news();

/// The line of this process, made when first asked for; it goes with the last who holds it.
std::shared_ptr<ProgressLine> progress_line();

}  // namespace dwell::cli
