#pragma once

namespace dwell::cli {

/// Makes threads that wait sleep instead of spin, which takes the processor from others for nothing: with two busy
/// processes beside, spinning took 39 % of all cycles. The OpenMP library reads OMP_WAIT_POLICY when it is loaded,
/// before main, so the program sets it and starts itself anew, once, under the same process number. Does nothing if the
/// user has set OMP_WAIT_POLICY or GOMP_SPINCOUNT, which also ends the second start, or if the program cannot be
/// started anew: it then works as before, only less politely.
void start_with_quiet_threads(char** argv);

}  // namespace dwell::cli
