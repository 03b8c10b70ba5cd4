#pragma once

namespace dwell::cli {

/// Makes waiting threads sleep. Threads that spin instead take the processor from others for nothing: beside two busy
/// processes, spinning took 39 % of all cycles. The OpenMP library reads OMP_WAIT_POLICY when it is loaded, before
/// main, so the program sets it and starts itself anew, once, under the same process number. Does nothing if the user
/// has set OMP_WAIT_POLICY or GOMP_SPINCOUNT, which also ends the second start, or if the program cannot be started
/// anew: it then works as before, and its threads spin.
void start_with_quiet_threads(char** argv);

}  // namespace dwell::cli
