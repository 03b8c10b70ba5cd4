#pragma once

#include <climits>  // tells which C library this is

/// Before a function with loops worth eight lanes: it is compiled for the processors of the last ten years as well as
/// for every one, and the loader picks; the last bits of a result may differ between processors. The sanitizers cannot
/// run such picks, which come before they have started.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DWELL_SIMD __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define DWELL_SIMD
#endif
