#pragma once

namespace dwell::cli {

/// Lets nothing unfinished stay on disk however the process ends by itself: the OpenMP library calls exit() where it
/// cannot start a thread, and an exception that no code can catch (out of memory in a thread of it) ends in
/// std::terminate. The latter is said on standard error, exit code 1. At the start of the program.
void leave_nothing_at_a_sudden_end();

}  // namespace dwell::cli
