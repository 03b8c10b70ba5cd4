#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dwell::bench {

enum class ChildEnd { Done, Killed, Failed };

/// Runs this very program with other arguments in a process of its own, with OMP_NUM_THREADS = threads, and waits. Its
/// memory and threads are its own, so one solver cannot disturb the next. Killed: it ended by SIGALRM.
ChildEnd run_child(const std::vector<std::string>& arguments, int threads);

}  // namespace dwell::bench
