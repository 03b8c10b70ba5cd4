#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dwell::bench {

enum class ChildEnd { Done, Killed, Failed };

struct ChildOptions {
  int threads = 1;               // OMP_NUM_THREADS
  double limit = 0.0;            // ended by SIGALRM after so many seconds of wall clock, rounded up; 0 = never
  std::filesystem::path output;  // takes its standard output and error; empty = those of this process
  bool one_processor = false;    // whatever the machine has, it may run on the first alone
  std::filesystem::path
      scratch{};                 // where it makes scratch folders, which go with this one; empty = the system's place
  double interrupt_after = 0.0;  // SIGINT, as of Ctrl-C, after so many seconds; 0 = never
};

struct ChildRun {
  ChildEnd end = ChildEnd::Failed;   // Killed: by SIGALRM
  int exit_code = -1;                // -1 if a signal ended it
  double seconds = 0.0;              // wall clock, from before it was started until it was gone
  double cpu_seconds = 0.0;          // of all its threads, in the program and in the kernel
  double interrupted_seconds = 0.0;  // from SIGINT until it was gone; 0 if it was not interrupted [s]
  double peak_memory = 0.0;          // resident, as the kernel tells on its end (ru_maxrss) [bytes]
};

/// From now on a first SIGINT (Ctrl-C) or SIGTERM ends the running child, and run_program throws Interrupted, so that
/// scratch folders are removed; a second ends this process at once.
void end_children_on_interrupt();

/// Runs a program in a process of its own and waits. Its memory and threads are its own, so one measurement cannot
/// disturb the next. Throws std::runtime_error if no process can be made, Interrupted.
ChildRun run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                     const ChildOptions& options);
/// The same with this very program.
ChildRun run_child(const std::vector<std::string>& arguments, const ChildOptions& options);

/// The last line of a file, as what a failed program printed; empty if there is none.
std::string last_line_of(const std::filesystem::path& file);

}  // namespace dwell::bench
